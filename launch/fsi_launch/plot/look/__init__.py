"""One look for all pictures: style, units, drawing many at once."""
