"""What a run wrote, as pictures need it: fields, cells, scales."""
