"""Where sphparam is."""

import bpy


class SphericalMapPreferences(bpy.types.AddonPreferences):
    """Where sphparam is."""

    bl_idname = __package__

    route: bpy.props.EnumProperty(
        name="Ask",
        items=[
            ("AUTO", "Package or Program", "The Python package, or the program where it is not there"),
            ("PACKAGE", "Python Package", "import sphparam, in Blender's own process"),
            ("PROGRAM", "Program", "sphparam, a process a step"),
        ],
    )
    package_folder: bpy.props.StringProperty(
        name="Package Folder", subtype="DIR_PATH",
        description="The folder in which the folder sphparam of the Python package is; empty: where Blender's "
        "Python looks",
    )  # fmt: skip
    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH", description="The program; empty: sphparam, where PATH says"
    )
    threads: bpy.props.IntProperty(
        name="Threads", description="0: all cores; the results are the same for any number", default=0, min=0
    )

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("route", "package_folder", "program", "threads"):
            self.layout.prop(self, name)


def preferences_of(context) -> SphericalMapPreferences:
    """Those of this add-on."""
    return context.preferences.addons[__package__].preferences


classes = (SphericalMapPreferences,)
