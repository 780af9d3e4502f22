"""What a run leaves: summary, verdict, probes, checkpoints to go on from."""
