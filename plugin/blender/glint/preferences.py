# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the glint command is: as the preferences say, inside the add-on, or on the path."""

import os
import shutil

import bpy

from . import compat


class GlintPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="glint command", description="Empty: the one inside the add-on, or on the path", subtype="FILE_PATH"
    )

    def draw(self, context):
        self.layout.prop(self, "command")
        found = find_command(context)
        self.layout.label(text=f"Found: {found}" if found else "Not found: comparing needs it", icon="INFO")


def find_command(context):
    """The path of the command, or None."""
    chosen = compat.preferences(context, __package__)
    if chosen is not None and chosen.command:
        path = bpy.path.abspath(chosen.command)
        return path if os.access(path, os.X_OK) else None
    own = os.path.join(os.path.dirname(os.path.realpath(__file__)), "bin", "glint")
    if os.path.isfile(own):
        if not os.access(own, os.X_OK):  # a zip that Blender unpacks loses the bit
            os.chmod(own, 0o755)
        return own
    return shutil.which("glint")


def register():
    bpy.utils.register_class(GlintPreferences)


def unregister():
    bpy.utils.unregister_class(GlintPreferences)
