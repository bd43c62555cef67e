"""Curated data as text: what tables there are, how a row is written, how a folder is read and checked."""
