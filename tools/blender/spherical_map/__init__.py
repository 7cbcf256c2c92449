# SPDX-License-Identifier: MIT
#
# Files of this folder that import bpy run inside Blender alone, which is under the GNU GPL, version 3 or
# later; together with it they are used under its terms, as the MIT licence permits.
"""Object › Spherical Map: one-to-one maps of meshes onto the sphere, proved, for Blender."""

bl_info = {
    "name": "Spherical Map",
    "author": "the sphparam authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Object > Spherical Map",
    "description": "Maps closed meshes one-to-one onto the sphere; bakes, remeshes, displaces by it",
    "warning": "Needs sphparam: its Python package or its program",
    "category": "UV",
}

if "bpy" in __import__("sys").modules:  # the core works without Blender
    import bpy

    from . import operators, panel, preferences

    _classes = (*preferences.classes, *operators.classes, *panel.classes)

    def register():
        """Called by Blender when the add-on is switched on."""
        for cls in _classes:
            bpy.utils.register_class(cls)
        panel.register()

    def unregister():
        """Called by Blender when it is switched off."""
        panel.unregister()
        for cls in reversed(_classes):
            bpy.utils.unregister_class(cls)
