"""Materials: one that shows what was baked, and those that stay behind."""

import bpy

from ..core.refusal import Refusal
from .mesh_reading import uv_name


def _node(tree, kind: str, label: str):
    """The node that we made before, or a new one."""
    found = next((n for n in tree.nodes if n.bl_idname == kind and n.label == label), None)
    if found is None:
        found = tree.nodes.new(kind)
        found.label = label
    return found


def require_editable_material(obj: bpy.types.Object) -> None:
    """Raises Refusal where its material, or the mesh that would get one, belongs to another file."""
    owner = obj.active_material or obj.data
    if owner.library is not None or (obj.active_material is None and obj.library is not None):
        raise Refusal(f"{owner.name} is linked from another file and can show nothing: Object › Relations › Make Local")


def left_with(source: bpy.types.Object) -> str:
    """What is told of a new mesh, which gets none of the source's materials: their UV maps are not its own. Empty:
    there are none."""
    count = len({slot.material.name_full for slot in source.material_slots if slot.material is not None})
    if count == 0:
        return ""
    return f"; {f'the {count} materials stay' if count > 1 else 'the material stays'} with {source.name}"


def _material_of(obj: bpy.types.Object) -> bpy.types.Material:
    if obj.active_material is None:
        made = bpy.data.materials.new(obj.name)
        made.use_nodes = True
        obj.data.materials.append(made)
        obj.active_material_index = len(obj.data.materials) - 1
    obj.active_material.use_nodes = True
    return obj.active_material


def show(obj: bpy.types.Object, field: str, image: bpy.types.Image) -> None:
    """Links an image into the object's material: base colour, a tangent-space normal map; others as
    colours. Textures are looked up by our UV map, repeating along u."""
    tree = _material_of(obj).node_tree
    shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if shader is None:
        shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
        output = next((n for n in tree.nodes if n.type == "OUTPUT_MATERIAL"), None) or tree.nodes.new(
            "ShaderNodeOutputMaterial"
        )
        tree.links.new(shader.outputs[0], output.inputs[0])
    place = _node(tree, "ShaderNodeUVMap", "sphparam uv")
    place.uv_map = uv_name
    is_normal = field == "normal-tangent"
    texture = _node(tree, "ShaderNodeTexImage", "sphparam " + ("normal" if is_normal else "colour"))
    texture.image = image
    tree.links.new(place.outputs[0], texture.inputs[0])
    if not is_normal:
        tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
        return
    normal = _node(tree, "ShaderNodeNormalMap", "sphparam normal map")
    normal.uv_map = uv_name
    tree.links.new(texture.outputs[0], normal.inputs["Color"])
    tree.links.new(normal.outputs[0], shader.inputs["Normal"])
