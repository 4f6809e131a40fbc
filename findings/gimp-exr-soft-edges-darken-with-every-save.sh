#!/usr/bin/env bash
# GIMP 2.10 multiplies an EXR's colours by its alpha once more each time it is opened and exported
#
# Tools    GIMP 2.10.34 (Debian 2.10.34-1+deb12u10)
# Date     2026-11-30
# Guess    An EXR holds colours that are multiplied by alpha; an editor of straight colours divides on opening and
#          multiplies on export. Open, change nothing, export: the same picture.
# Seen     Only the second half happens. A pixel of half coverage, colour 0.25 (so 0.125 in the file), through GIMP and
#          out as EXR, again and again:
#            stored colour  0.125 -> 0.0625 -> 0.03125 -> 0.015625      alpha stays 0.5, opaque pixels stay 0.25
#          A PNG (straight colours) of the same pixel comes out as 0.125: the export is right, the opening is not.
# Matters  A layer, matte or texture with soft edges, painted on in GIMP between two renders, comes back with dark
#          fringes; motion blur, defocus, glass and smoke get too dark by their own alpha. The inside is
#          right, so a spot check passes, and each round of retouching makes it worse.
# Do       Send GIMP a straight PNG or TIFF of 16 bits or more, or an EXR divided by its alpha beforehand; its exported
#          EXR is then right (0.125 here). Krita 5.1 does not have the fault.
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
need gimp 2.10.34-1+deb12u10
need python3-openimageio 2.4.7.1+dfsg-2
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
export HOME="$tmp/home" GIMP2_DIRECTORY="$tmp/gimp"
mkdir "$HOME"
/usr/bin/python3 - <<'PY'
import numpy as np
import OpenImageIO as oiio
def write(name, kind, half_covered):
    pixels = np.zeros((16, 16, 4), np.float32)
    pixels[:8] = (0.25, 0.25, 0.25, 1.0)
    pixels[8:] = (half_covered,) * 3 + (0.5,)
    spec = oiio.ImageSpec(16, 16, 4, kind)
    out = oiio.ImageOutput.create(name)
    assert out.open(name, spec) and out.write_image(pixels) and out.close()
write("in0.exr", "float", 0.125)
write("divided.exr", "float", 0.25)
display = 1.055 * 0.25 ** (1 / 2.4) - 0.055  # 0.25 of linear light in a PNG
pixels = np.full((16, 16, 4), display, np.float32)
pixels[:8, :, 3], pixels[8:, :, 3] = 1.0, 0.5
spec = oiio.ImageSpec(16, 16, 4, "uint16")
spec["oiio:UnassociatedAlpha"] = 1  # take the numbers as they are
out = oiio.ImageOutput.create("straight.png")
assert out.open("straight.png", spec) and out.write_image(pixels) and out.close()
PY
cat > batch.scm <<SCM
(define (through from to)
  (let* ((image (car (gimp-file-load RUN-NONINTERACTIVE from from)))
         (drawable (car (gimp-image-get-active-drawable image))))
    (gimp-file-save RUN-NONINTERACTIVE image drawable to to)
    (gimp-image-delete image)))
(through "$tmp/in0.exr" "$tmp/in1.exr")
(through "$tmp/in1.exr" "$tmp/in2.exr")
(through "$tmp/in2.exr" "$tmp/in3.exr")
(through "$tmp/divided.exr" "$tmp/divided_out.exr")
(through "$tmp/straight.png" "$tmp/png.exr")
(gimp-quit 0)
SCM
timeout 300 gimp -i -d -f -b - <batch.scm >gimp.log 2>&1 || { cat gimp.log; exit 1; }
/usr/bin/python3 - <<'PY'
import sys
import numpy as np
import OpenImageIO as oiio
def read(name):
    file = oiio.ImageInput.open(name)
    pixels = np.asarray(file.read_image("float")).reshape(16, 16, -1)
    file.close()
    return pixels[2, 2], pixels[12, 12]
failed = []
for passes in range(4):
    solid, soft = read(f"in{passes}.exr")
    print(f"{passes} times through GIMP: opaque {solid}, half covered {soft}")
    if abs(solid - (0.25, 0.25, 0.25, 1)).max() > 1e-4: failed.append(f"opaque pixels after {passes} (a control)")
    expected = (0.125 / 2 ** passes,) * 3 + (0.5,)
    if abs(soft - expected).max() > 1e-4: failed.append(f"half covered pixels after {passes}")
solid, soft = read("png.exr")
print(f"a straight PNG to EXR: opaque {solid.round(5)}, half covered {soft.round(5)}")
if abs(solid[0] - 0.25) > 1e-4 or abs(soft[0] - 0.125) > 1e-4: failed.append("a straight PNG is exported right (the control)")
solid, soft = read("divided_out.exr")
print(f"an EXR divided by its alpha first: half covered {soft.round(5)}")
if abs(soft[0] - 0.125) > 1e-4: failed.append("an EXR that was divided first comes out right")
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
