#!/usr/bin/env bash
# Blender's Corner Pin, Scale and Transform shift what they magnify s-fold by (s - 1)/2 pixels; Map UV does not
#
# Tools    Blender 3.4.1 (Debian 3.4.1+dfsg-2+b1), compositor
# Date     2026-11-30
# Guess    Corner Pin, Scale, Transform and Map UV, set to the same enlargement about the picture's centre, give the same
#          picture, and that centre stays where it is.
# Seen     A picture whose colour is its own position. Shift of what is shown, in pixels of the result, to the left and
#          (by as much) downwards:
#            factor   Corner Pin   Scale    Transform   Map UV
#            0.5        -0.250    -0.250     -0.250     0.000
#            1           0.000     0.000      0.000     0.000
#            2           0.500     0.500      0.500     0.000
#            4           1.500     1.500      1.500     0.000
#          A pin that changes nothing is exact, so a test with one does not show it: the nodes turn pixel numbers into
#          positions without the half pixel between a pixel's corner and its centre.
# Matters  A tracked corner pin (this is what trackers and texture replacement tools export for Blender) puts a small
#          picture onto a large surface beside its place, and one that comes nearer slides over the surface: from half
#          the size to four times it by 1.75 px. The same move through an ST-map stays put, so the two do not match.
# Do       Use an ST-map with Map UV where the magnification is not about 1. Or move the corners that are given to the
#          node by the shift the other way: for an enlargement s, (s - 1)/2 px to the right and up (0.000 px are left of
#          the shift then); or give the node a picture of about the size at which it is shown.
set -euo pipefail

need() { # PACKAGE VERSION
  local have
  have=$(dpkg-query -W -f='${db:Status-Status} ${Version}' "$1" 2>/dev/null) || have=
  case $have in "installed "*) have=${have#installed } ;; *) have= ;; esac
  if [ -z "$have" ]; then
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$1=$2"; } \
      >/dev/null || { echo "refused: $1 $2 is not installed and could not be" >&2; exit 2; }
    have=$2
  fi
  [ "$have" = "$2" ] || { echo "refused: $1 is $have, this was measured with $2" >&2; exit 2; }
}
need blender 3.4.1+dfsg-2+b1
need python3-openimageio 2.4.7.1+dfsg-2
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import numpy as np
import OpenImageIO as oiio
W, H = 256, 128
x, y = np.meshgrid(np.arange(W) + 0.5, np.arange(H) + 0.5)
def write(name, *channels):
    image = oiio.ImageBuf(oiio.ImageSpec(W, H, 4, "float"))
    image.set_pixels(oiio.ROI(), np.dstack(channels).astype(np.float32))
    assert image.write(name)
one = np.ones_like(x)
write("position.exr", x, y, 0 * x, one)  # the colour of a pixel is its position, y from the top
for s in (0.5, 1, 2, 4):
    write(f"uv{s:g}.exr", ((x - W / 2) / s + W / 2) / W, 1 - ((y - H / 2) / s + H / 2) / H, one, one)
PY
cat > comp.py <<'PY'
import bpy, os
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 256, 128, 100
settings = scene.render.image_settings
settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGBA"
scene.use_nodes = True
tree = scene.node_tree

def picture(name):
    node = tree.nodes.new("CompositorNodeImage")
    node.image = bpy.data.images.load(os.path.abspath(name))
    node.image.colorspace_settings.name = "Non-Color"
    return node.outputs[0]

def render(name, kind, s):
    tree.nodes.clear()
    node = tree.nodes.new("CompositorNode" + kind.split("+")[0])
    tree.links.new(picture("position.exr"), node.inputs[0])
    low, high = 0.5 - s / 2, 0.5 + s / 2
    if kind.startswith("CornerPin"):  # upper left, upper right, lower left, lower right; y upwards
        moved = (s - 1) / 2 if kind.endswith("+moved") else 0
        for i, (u, v) in enumerate(((low, high), (high, high), (low, low), (high, low))):
            node.inputs[1 + i].default_value = (u + moved / 256, v + moved / 128, 0)
    elif kind == "Scale":
        node.space = "RELATIVE"
        node.inputs[1].default_value = node.inputs[2].default_value = s
    elif kind == "Transform":
        node.filter_type = "BILINEAR"
        node.inputs[4].default_value = s
    else:
        node.alpha = 0
        tree.links.new(picture(f"uv{s:g}.exr"), node.inputs[1])
    tree.links.new(node.outputs[0], tree.nodes.new("CompositorNodeComposite").inputs[0])
    scene.render.filepath = os.path.abspath(f"{name}_{s:g}.exr")
    bpy.ops.render.render(write_still=True)

for kind in ("CornerPin", "Scale", "Transform", "MapUV", "CornerPin+moved"):
    for s in (0.5, 1, 2, 4):
        render(kind, kind, s)
PY
blender -b --factory-startup -P comp.py >blender.log 2>&1 || { cat blender.log; exit 1; }
/usr/bin/python3 - <<'PY'
import sys
import numpy as np
import OpenImageIO as oiio
W, H = 256, 128
x, y = np.meshgrid(np.arange(W) + 0.5, np.arange(H) + 0.5)
middle = (slice(H // 2 - 16, H // 2 + 16), slice(W // 2 - 16, W // 2 + 16))
failed = []
for kind in ("CornerPin", "Scale", "Transform", "MapUV", "CornerPin+moved"):
    for s in (0.5, 1, 2, 4):
        file = oiio.ImageInput.open(f"{kind}_{s:g}.exr")
        shown = np.asarray(file.read_image("float")).reshape(H, W, -1)
        file.close()
        left = float((shown[..., 0] - ((x - W / 2) / s + W / 2))[middle].mean()) * s
        down = -float((shown[..., 1] - ((y - H / 2) / s + H / 2))[middle].mean()) * s
        print(f"{kind:15} x {s:<3g}  shifted to the left by {left:6.3f} px, downwards by {down:6.3f} px")
        expected = 0.0 if kind in ("MapUV", "CornerPin+moved") else (s - 1) / 2
        if abs(left - expected) > 0.02 or abs(down - expected) > 0.02:
            failed.append(f"{kind} x {s:g}: expected {expected:.3f}" + (" (a control)" if expected == 0 else ""))
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
