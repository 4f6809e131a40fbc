#!/usr/bin/env bash
# ffmpeg cuts off floats in a half EXR instead of rounding: the right half of a 4K ST-map shifts by a pixel
#
# Tools    ffmpeg 5.1.9 (Debian 7:5.1.9-0+deb12u1); against OpenImageIO 2.4.7 (2.4.7.1+dfsg-2) with OpenEXR 3.1.5
# Date     2026-11-30
# Guess    A conversion from float to half takes the nearest value, as the processor's own instruction and OpenEXR do:
#          errors up to half a step on either side, 0 on average.
# Seen     Every value that no half can hold becomes the next one nearer to 0. An ST-map over 4096 pixels, errors in px:
#            writer                      smallest   largest   mean    mean in the right half
#            ffmpeg -format half           -1.5       0.0    -0.625          -1.000
#            OpenImageIO / OpenEXR         -0.5       0.5     0.000           0.000
#            ffmpeg -format float           0.0       0.0     0.000           0.000
#          Light is cut the same way: of 4096 values from 1 to 8 none gets brighter, 4096 get darker.
# Matters  That half floats are too coarse for ST-maps is known, but their noise is expected to average out. Here a texture
#          moves to the right as a whole, by 1 px in the right half of the picture and 1/2 px in the quarter before it: it
#          does not fit the plate, and it jumps where the map passes 1/2 and 1/4.
# Do       -format float for maps, coordinates and depth. Where half is wanted, convert with oiiotool -d half; a file
#          that was cut so cannot be told from a rounded one.
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
need ffmpeg 7:5.1.9-0+deb12u1
need libavcodec59 7:5.1.9-0+deb12u1
need python3-openimageio 2.4.7.1+dfsg-2
need libopenexr-3-1-30 3.1.5-5
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import subprocess, sys
import numpy as np
import OpenImageIO as oiio

W = 4096
failed = []
def check(what, ok):
    if not ok: failed.append(what)

def read(name, kind):
    file = oiio.ImageInput.open(name)
    assert str(file.spec().format) == kind, (name, file.spec().format)
    row = np.asarray(file.read_image("float")).reshape(W, -1)[:, 0].astype(float)
    file.close()
    return row

def by_ffmpeg(values, kind):
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "gbrpf32le", "-s", f"{W}x1", "-i", "-",
                    "-frames:v", "1", "-c:v", "exr", "-format", kind, "ffmpeg.exr"],
                   input=np.tile(values, 3).tobytes(), check=True)
    return read("ffmpeg.exr", kind)

def by_oiio(values):
    out = oiio.ImageOutput.create("oiio.exr")
    assert out.open("oiio.exr", oiio.ImageSpec(W, 1, 3, "half"))
    assert out.write_image(np.repeat(values[None, :, None], 3, axis=2)) and out.close()
    return read("oiio.exr", "half")

s = ((np.arange(W) + 0.5) / W).astype("<f4")  # exact in float
def report(who, row):
    e = (row - s) * W
    print(f"{who:22} error in px: {e.min():6.3f} to {e.max():6.3f}, mean {e.mean():6.3f}, in the second quarter"
          f" {e[W // 4:W // 2].mean():6.3f}, in the right half {e[W // 2:].mean():6.3f}")
    return e

e = report("OpenImageIO, half", by_oiio(s))
check("control: OpenEXR rounds to the nearest", e.min() == -0.5 and e.max() == 0.5 and abs(e.mean()) < 1e-6)
check("control: numpy's halves are the same", bool((by_oiio(s) == s.astype(np.float16).astype(float)).all()))
e = report("ffmpeg, float", by_ffmpeg(s, "float"))
check("control: ffmpeg's floats are exact", bool((e == 0).all()))
e = report("ffmpeg, half", by_ffmpeg(s, "half"))
check("ffmpeg's halves are never above the value", e.max() == 0 and e.min() == -1.5)
check("the right half is off by 1 px", abs(e[W // 2:].mean() + 1) < 1e-6)
check("the second quarter by 1/2 px", abs(e[W // 4:W // 2].mean() + 0.5) < 1e-6)
light = (1 + 7 * (np.arange(W) + 0.5) / W).astype("<f4")
d = by_ffmpeg(light, "half") - light
print(f"4096 values from 1 to 8 through ffmpeg: {int((d > 0).sum())} brighter, {int((d < 0).sum())} darker")
check("light only gets darker", int((d > 0).sum()) == 0 and int((d < 0).sum()) == W)
d = by_ffmpeg(-light, "half") + light
check("control: negative values are cut towards 0 too, not downwards", int((d < 0).sum()) == 0)
halves = light.astype(np.float16).astype("<f4")
check("control: values that are halves already stay", bool((by_ffmpeg(halves, "half") == halves).all()))
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
