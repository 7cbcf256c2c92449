"""The operators of the menu Object › Spherical Map."""

from . import bake, control, map, remesh

classes = (map.SPHERICAL_MAP_OT_map, bake.SPHERICAL_MAP_OT_bake, remesh.SPHERICAL_MAP_OT_remesh,
           control.SPHERICAL_MAP_OT_control)  # fmt: skip
