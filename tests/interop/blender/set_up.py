"""Installs the add-on for good, as a user does in the preferences."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
from support import install

install()
bpy.context.preferences.view.show_splash = False
bpy.ops.wm.save_userpref()
