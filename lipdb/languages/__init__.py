"""Languages: make the folder of a new one, and check that a folder keeps what it promises."""
