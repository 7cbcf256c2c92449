"""Bake: what a mapped mesh shows, as an image."""

import bpy

from ..core import steps
from ..core.refusal import Refusal
from ..core.routes import BakeSettings
from ..scene import images, materials, mesh_reading
from .running import RunningOperator

_fields = [
    ("basecolor", "Base Colour", "The image of the material, or the colours of the vertices"),
    ("normal-object", "Normals (object)", "Unit normals in the axes of the mesh"),
    ("normal-tangent", "Normals (tangent)", "Unit normals in the tangent frame of the UV map"),
    ("ao", "Ambient Occlusion", "How much of the sky is seen"),
    ("bent", "Bent Normals", "Mean direction of the sky that is seen"),
    ("thickness", "Thickness", "Mean way inwards to the other side"),
    ("curvature", "Mean Curvature", "Mean curvature"),
    ("curvature:gauss", "Gauss Curvature", "Gauss curvature"),
    ("position", "Position", "x y z"),
    ("height", "Height", "Height of the selected mesh over the active one; of one mesh, distance from its origin"),
    ("area", "Area Distortion", "log2 of the ratio of areas, sphere to mesh"),
    ("angle", "Angle Distortion", "log2 of the factor by which angles are off"),
    ("checker", "Checker", "A test image"),
    ("graticule", "Graticule", "Meridians and parallels"),
    ("scalar", "Attribute", "Numbers that vertices carry"),
]
_coloured = ("basecolor", "checker", "graticule")


class SPHERICAL_MAP_OT_bake(RunningOperator, bpy.types.Operator):
    """Bake the active mesh into an equirectangular image; with another mapped mesh on the same sphere
    selected, that one is baked for the active one"""

    bl_idname = "object.spherical_map_bake"
    bl_label = "Bake Spherical Image"
    bl_options = {"REGISTER", "UNDO"}

    field: bpy.props.EnumProperty(name="Map", items=_fields)
    attribute: bpy.props.StringProperty(name="Attribute", description="Which numbers, of Attribute")
    size: bpy.props.IntProperty(name="Width", description="Texels a row; half as many rows", default=2048,
                                min=4, max=32768, step=2)  # fmt: skip
    samples: bpy.props.IntProperty(name="Samples", description="N × N a texel", default=1, min=1, max=32)
    rays: bpy.props.IntProperty(name="Rays", description="A sample, of occlusion, bent normals, thickness",
                                default=64, min=1, max=65536)  # fmt: skip
    show: bpy.props.BoolProperty(
        name="Show in Material", description="Link the image into the material of the active mesh", default=False
    )

    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("field", "attribute", "size", "samples", "rays", "show"):
            if name == "attribute" and self.field != "scalar":
                continue
            if name == "rays" and self.field not in ("ao", "bent", "thickness"):
                continue
            self.layout.prop(self, name)

    def gather(self, context):
        if self.size % 2:
            raise Refusal(f"Width: an even number is needed, not {self.size}")
        target = context.object
        if self.show:
            materials.require_editable_material(target)
        others = [o for o in context.selected_objects if o.type == "MESH" and o.data != target.data]
        if len(others) > 1:
            raise Refusal(f"{len(others)} meshes are selected besides {target.name}: select one to bake from")
        source = others[0] if others else target
        self._target = target.name
        baking = steps.Baking(
            self._surface_of(source),
            f"scalar:{self.attribute}" if self.field == "scalar" else self.field,
            ".png" if self.field in (*_coloured, "normal-tangent") else ".exr",
            BakeSettings(self.size, self.samples, rays=self.rays),
            target=self._surface_of(target) if others else None,
        )
        if self.field == "basecolor":
            self._add_texture(baking, source)
        return baking

    def work(self, gathered):
        return lambda route, folder: steps.bake(route, folder, gathered)

    def finish(self, context, result):
        target = bpy.data.objects[self._target]
        name = f"{target.name} {self.attribute if self.field == 'scalar' else self.field}"
        image = images.of_file(result, name, self.field not in _coloured)
        if self.show:
            materials.show(target, self.field, image)
        return f"{name}: {image.size[0]} × {image.size[1]}"

    def _add_texture(self, baking, source):
        found = images.base_colour_of(source)
        if found is None and baking.surface.colours is None:
            raise Refusal(f"{source.name} has no image as base colour, and its vertices have no colours")
        if found is None:
            return
        baking.surface.uv = found.uv
        baking.texture = images.file_of(found.image)
        baking.settings.filter = found.filter

    def _surface_of(self, obj):
        surface = mesh_reading.surface_of(obj, with_directions=True)
        surface.normals = mesh_reading.loop_normals(obj.data)
        surface.colours = mesh_reading.colours_of(obj.data, images.colour_name_of(obj))
        if self.field == "scalar":
            surface.scalars = mesh_reading.scalars_of(obj.data)
            if self.attribute not in surface.scalars:
                known = ", ".join(surface.scalars) or "none"
                raise Refusal(f"{obj.name} has no numbers of vertices called {self.attribute!r}; it has {known}")
        return surface
