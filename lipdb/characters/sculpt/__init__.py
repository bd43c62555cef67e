"""Shapes from formulas: what the shipped characters are built with."""
