"""Pictures of several runs, of convergence and of studies."""
