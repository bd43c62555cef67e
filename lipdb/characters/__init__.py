"""Faces: pose sets, links from poses to shapes, meshes and pictures."""
