"""Meshes, images, modifiers and materials of Blender, from arrays and back."""
