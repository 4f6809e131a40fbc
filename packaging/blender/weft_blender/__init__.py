"""Weft in Blender: sends a marked object with all that Weft can use of it, and brings the result back."""
bl_info = {
    "name": "Weft",
    "author": "The Weft authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Weft",
    "description": "Replace the texture of an object in its rendered shot",
    "category": "Compositing",
}

import bpy  # noqa: E402

from . import bring, panel, send  # noqa: E402

CLASSES = (panel.WeftSettings, panel.WeftPreferences, send.WEFT_OT_send, bring.WEFT_OT_render, bring.WEFT_OT_bring_back,
           panel.WEFT_OT_open, panel.WEFT_PT_panel)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.weft = bpy.props.PointerProperty(type=panel.WeftSettings)


def unregister():
    del bpy.types.Scene.weft
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
