"""The Python half of ./launch/fsi: starts, watches and ends programs, merges what they report, draws pictures."""
