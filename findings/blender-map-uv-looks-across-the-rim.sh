#!/usr/bin/env bash
# Blender's Map UV fetches colours from 40 pixels away at the rim of a map, and its Alpha fades every pixel instead
#
# Tools    Blender 3.4.1 (Debian 3.4.1+dfsg-2+b1), compositor
# Date     2026-11-30
# Guess    Where the map's own pixel says (u, v), the picture at (u, v) comes out, also in the last pixel before the map
#          ends. The setting Alpha (0 to 100; the manual: a threshold to fade out pixels on discontinuities) acts there
#          and leaves a smooth map alone.
# Seen     An identity map of 256 x 128, whole, and cut to a disc of 5024 pixels (0 outside, coverage in blue):
#            map                        Alpha    off at the worst pixel    alpha in the middle
#            whole                        0             0.00 px                 1.000
#            cut to the disc              0            41.47 px                 1.000   (148 pixels by more than 1 px)
#            cut two pixels further out   0             0.00 px                 1.000   (inside of the disc)
#            whole                      100             0.00 px                 0.941
#            cut to the disc            100             0.00 px                 0.941   (224 pixels of the rim are gone)
#            whole, at half the size    100                                   0.883
#          "Off" is measured on the colours as they are shown at Alpha 0, and on colours divided by alpha at 100.
#          The node filters over the difference to the neighbouring pixels of the map; next to a pixel without a map
#          this is the distance to the corner (0, 0). The setting takes from the alpha in proportion to that difference,
#          which is 0 in no map: an identity map of 256 x 128 loses 5.9 %, one that halves the picture's size 11.7 %.
# Matters  A UV pass or ST-map that ends at the matte gives the replaced texture a rim in the colours of another place
#          of the texture: noise that crawls around the matte. The slider that is made against it makes the whole
#          replacement transparent, so the old texture shows through by a few percent, unnoticed in a still.
# Do       Let the map go on for two pixels past the coverage, leave Alpha at 0, and cut with the coverage after the node.
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
for name, radius in (("whole", 1e9), ("disc", 40), ("wider", 42)):
    c = ((x - 128) ** 2 + (y - 64) ** 2 < radius ** 2).astype(float)
    write(f"uv_{name}.exr", x / W * c, (1 - y / H) * c, c, c)
write("uv_twice.exr", 2 * x / W - 0.5, 1.5 - 2 * y / H, one, one)  # about the middle, at half the size
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

for name, alpha in (("whole", 0), ("disc", 0), ("wider", 0), ("whole", 100), ("disc", 100), ("twice", 100)):
    tree.nodes.clear()
    node = tree.nodes.new("CompositorNodeMapUV")
    node.alpha = alpha
    tree.links.new(picture("position.exr"), node.inputs[0])
    tree.links.new(picture(f"uv_{name}.exr"), node.inputs[1])
    tree.links.new(node.outputs[0], tree.nodes.new("CompositorNodeComposite").inputs[0])
    scene.render.filepath = os.path.abspath(f"{name}_{alpha}.exr")
    bpy.ops.render.render(write_still=True)
PY
blender -b --factory-startup -P comp.py >blender.log 2>&1 || { cat blender.log; exit 1; }
/usr/bin/python3 - <<'PY'
import sys
import numpy as np
import OpenImageIO as oiio
W, H = 256, 128
x, y = np.meshgrid(np.arange(W) + 0.5, np.arange(H) + 0.5)
disc = (x - 128) ** 2 + (y - 64) ** 2 < 40 ** 2
failed = []
def check(what, ok):
    if not ok: failed.append(what)
def measure(name, alpha):
    file = oiio.ImageInput.open(f"{name}_{alpha}.exr")
    shown = np.asarray(file.read_image("float")).reshape(H, W, -1).astype(float)
    file.close()
    a = shown[..., 3]
    colour = shown[..., :2] / np.maximum(a, 1e-9)[..., None] if alpha else shown[..., :2]
    off = np.hypot(colour[..., 0] - x, colour[..., 1] - y)[disc & (a > 0.02)]
    gone = int((disc & (a <= 0.02)).sum())
    print(f"{name:6} Alpha {alpha:3}: largest error {off.max():6.2f} px, {int((off > 1).sum()):4} of {int(disc.sum())}"
          f" pixels by more than 1 px, {gone:4} gone, alpha in the middle {a[64, 128]:.4f}")
    return float(off.max()), int((off > 1).sum()), gone, float(a[64, 128])
worst, count, gone, middle = measure("whole", 0)
check("control: the whole map is exact at Alpha 0", worst < 0.01 and gone == 0 and abs(middle - 1) < 1e-4)
worst, count, gone, middle = measure("disc", 0)
check("the cut map is off by about 41 px at its rim", 38 < worst < 45 and 120 < count < 170 and gone == 0)
worst, count, gone, middle = measure("wider", 0)
check("control: the same disc is exact where the map goes on", worst < 0.01 and gone == 0)
worst, count, gone, middle = measure("whole", 100)
check("at Alpha 100 a whole map is faded to 0.941", abs(middle - 0.9414) < 0.002 and worst < 0.01)
worst, count, gone, middle = measure("disc", 100)
check("at Alpha 100 the rim is gone and the rest is faded", 180 < gone < 270 and abs(middle - 0.9414) < 0.002 and worst < 0.01)
file = oiio.ImageInput.open("twice_100.exr")
middle = float(np.asarray(file.read_image("float"))[64, 128, 3])
file.close()
print(f"a map that shows the picture at half its size, Alpha 100: alpha in the middle {middle:.4f}")
check("and one that shows it at half its size is faded twice as much", abs(middle - 0.8828) < 0.003)
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
