"""The add-on's settings and its panel in the sidebar of the 3D viewport."""
import os
import subprocess

import bpy

from . import program

PROJECT, OUTPUT, TREE = "shot.weft", "out/####.exr", "out/weft.py"
# In files of their own: of a file with layers of Blender's, Blender shows no others.
LAYERS_OUTPUT = "layers/####.exr"


class WeftSettings(bpy.types.PropertyGroup):
    folder: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH", default="//weft",
                                     description="Where the passes, the project and the result are")
    texture: bpy.props.StringProperty(name="Texture", subtype="FILE_PATH",
                                      description="Sample of the new texture; empty: choose it in Weft")
    side: bpy.props.IntProperty(name="Side", default=1024, min=64, max=8192,
                                description="Pixels of the texture that is brought back by UVs")


class WeftPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH",
                                      description="weft; empty: the one on the PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


def weft_of(context):
    """The program. Raises program.Failed."""
    addon = context.preferences.addons.get(__package__)
    return program.find(addon.preferences.program if addon else "")


def folder_of(scene):
    """The folder, absolute. Raises program.Failed for one beside a file that was never saved."""
    folder = scene.weft.folder
    if folder.startswith("//") and not bpy.data.filepath:
        raise program.Failed("Save the file first, or choose a folder that does not begin with //.")
    return os.path.abspath(bpy.path.abspath(folder))


class WEFT_OT_open(bpy.types.Operator):
    """Open the project in Weft's editor"""

    bl_idname = "weft.open"
    bl_label = "Open in Weft"

    def execute(self, context):
        try:
            weft, folder = weft_of(context), folder_of(context.scene)
        except program.Failed as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not os.path.exists(os.path.join(folder, PROJECT)):
            self.report({"ERROR"}, "Send an object to Weft first.")
            return {"CANCELLED"}
        subprocess.Popen([weft, "edit", PROJECT], cwd=folder)
        return {"FINISHED"}


class WEFT_PT_panel(bpy.types.Panel):
    bl_label = "Weft"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Weft"

    def draw(self, context):
        layout, settings = self.layout, context.scene.weft
        layout.prop(settings, "folder")
        layout.prop(settings, "texture")
        layout.operator("weft.send")
        row = layout.row(align=True)
        row.operator("weft.open")
        row.operator("weft.render")
        column = layout.column(align=True)
        column.label(text="Bring back as")
        column.operator("weft.bring_back", text="Image sequence").kind = "SEQUENCE"
        column.operator("weft.bring_back", text="Compositor nodes").kind = "COMPOSITOR"
        column.operator("weft.bring_back", text="Texture by UVs").kind = "TEXTURE"
        column.prop(settings, "side")
