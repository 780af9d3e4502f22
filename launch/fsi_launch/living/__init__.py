"""A run while it lives: its processes, how they end, who hears of it."""
