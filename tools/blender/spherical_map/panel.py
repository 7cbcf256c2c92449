"""Where the operators are found: Object › Spherical Map, and a panel in the sidebar of the 3D view."""

import bpy

_entries = (
    ("object.spherical_map", "Map", "MESH_UVSPHERE"),
    ("object.spherical_map_bake", "Bake Image…", "IMAGE_DATA"),
    ("object.spherical_map_remesh", "Remesh…", "MESH_ICOSPHERE"),
    ("object.spherical_map_control", "Control Mesh and Displacement…", "MOD_SUBSURF"),
)


def _draw_entries(layout):
    for name, label, icon in _entries:
        layout.operator(name, text=label, icon=icon)


class VIEW3D_MT_spherical_map(bpy.types.Menu):
    """Maps onto the sphere, and what they are good for"""

    bl_label = "Spherical Map"

    def draw(self, context):
        # From a menu, dialogues are asked for.
        self.layout.operator_context = "INVOKE_DEFAULT"
        _draw_entries(self.layout)


class VIEW3D_PT_spherical_map(bpy.types.Panel):
    """What is known of the active mesh's map"""

    bl_label = "Spherical Map"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Spherical Map"

    def draw(self, context):
        obj = context.object
        _draw_entries(self.layout.column(align=True))
        if obj is not None and obj.type == "MESH":
            said = obj.data.get("spherical_map")
            told = self.layout.column(align=True)
            for number, words in enumerate((said or "no map yet").split(", ")):
                told.label(text=words, icon="CHECKMARK" if said and not number else "NONE")


def _in_object_menu(self, context):
    self.layout.separator()
    self.layout.menu("VIEW3D_MT_spherical_map")


classes = (VIEW3D_MT_spherical_map, VIEW3D_PT_spherical_map)


def register():
    bpy.types.VIEW3D_MT_object.append(_in_object_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(_in_object_menu)
