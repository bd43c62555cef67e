"""Coverage: which pairs of phones real text needs."""
