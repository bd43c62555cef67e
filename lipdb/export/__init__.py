"""Write a performance to files."""
