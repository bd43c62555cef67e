"""Lip sync data for any language and any face."""
