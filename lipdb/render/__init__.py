"""Draw a performance."""
