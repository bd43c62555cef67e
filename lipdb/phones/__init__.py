"""Phones: symbols, aliases, and the common phones they map to."""
