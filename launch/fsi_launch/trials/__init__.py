"""The software itself: its tests, its speed, its faults."""
