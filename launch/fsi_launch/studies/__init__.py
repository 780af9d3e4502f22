"""Many runs of one case: finer grids, other values."""
