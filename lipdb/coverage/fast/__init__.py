"""The fast way of counting: each word asked of the voice once, read as its place asks."""
