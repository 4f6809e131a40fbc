#!/usr/bin/env bash
# ffmpeg's lut3d and lut1d ignore the DOMAIN_MIN of a .cube, and a DOMAIN_MAX below 1
#
# Tools    ffmpeg 5.1.9 (Debian 7:5.1.9-0+deb12u1); judged by OpenColorIO 2.1.2 (2.1.2+dfsg1-4+b3)
# Date     2026-11-30
# Guess    A .cube says with DOMAIN_MIN and DOMAIN_MAX which input its first and its last entry stand for, so an
#          identity LUT over any domain changes nothing inside of that domain.
# Seen     The input is divided by the length of the domain and its start is never subtracted, and the division is
#          left out where it would enlarge. An identity LUT moves every value by DOMAIN_MIN, without a warning:
#            domain          input  OpenColorIO  ffmpeg lut3d
#             0     to 1      0.50     0.500        0.500
#            -0.5   to 1.5    0.50     0.500        0.000
#            -0.073 to 1.095  0.50     0.500        0.427
#             0     to 2      0.50     0.500        0.500    (a longer domain from 0 works, which hides the fault)
#             0     to 0.5    0.25     0.250        0.125
#          lut1d does the same: 0.50 becomes 0.000 over -0.5 to 1.5.
# Matters  The look of a shot often comes as a .cube, and one made for camera log or for extended range has a domain
#          like -0.073 to 1.095. Through ffmpeg the preview of a replaced texture is darker
#          by 7 % of white than the same LUT in a compositor; one then corrects a texture that was right.
# Do       Bake the LUT anew over 0 to 1, or shift the picture first (subtract DOMAIN_MIN and divide by the length, with
#          a LUT that states no domain); apply other domains with OpenColorIO.
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
need libavfilter8 7:5.1.9-0+deb12u1
need libopencolorio2.1 2.1.2+dfsg1-4+b3
need python3-pyopencolorio 2.1.2+dfsg1-4+b3
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import subprocess, sys
import numpy as np
import PyOpenColorIO as ocio

VALUES = [0.0, 0.25, 0.5, 0.75, 1.0]

def write_cube(name, low, high, size=33, dimensions=3):
    at = [low + (high - low) * i / (size - 1) for i in range(size)]
    with open(name, "w") as f:
        f.write(f"LUT_{dimensions}D_SIZE {size}\n")
        f.write(f"DOMAIN_MIN {low} {low} {low}\nDOMAIN_MAX {high} {high} {high}\n")
        if dimensions == 1:
            f.writelines(f"{v:.7f} {v:.7f} {v:.7f}\n" for v in at)
        else:
            f.writelines(f"{r:.7f} {g:.7f} {b:.7f}\n" for b in at for g in at for r in at)

def by_ffmpeg(name, kind):
    row = np.array(VALUES * 4, "<f4")  # 20 x 1 pixels, planes G, B, R: floats the whole way
    out = subprocess.run(
        ["ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "gbrpf32le", "-s", "20x1", "-i", "-",
         "-vf", f"{kind}={name}", "-pix_fmt", "gbrpf32le", "-f", "rawvideo", "-"],
        input=np.tile(row, 3).tobytes(), stdout=subprocess.PIPE, check=True).stdout
    return np.frombuffer(out, "<f4").reshape(3, 20)[2, :5]

def by_ocio(name):
    transform = ocio.FileTransform(name, interpolation=ocio.INTERP_LINEAR)
    cpu = ocio.Config.CreateRaw().getProcessor(transform).getDefaultCPUProcessor()
    return np.array([cpu.applyRGB([v, v, v])[0] for v in VALUES])

failed = []
def check(what, ok):
    if not ok: failed.append(what)

def measure(low, high, dimensions=3):
    name = f"lut_{low}_{high}_{dimensions}.cube"
    write_cube(name, low, high, dimensions=dimensions)
    f, o = by_ffmpeg(name, f"lut{dimensions}d"), by_ocio(name)
    print(f"{dimensions}D identity over {low} to {high}: input {VALUES} OpenColorIO {o.round(3)} ffmpeg {f.round(3)}")
    return f, o

v = np.array(VALUES)
close = lambda a, b: bool(np.abs(a - b).max() < 0.001)
for dimensions in (3, 1):
    f, o = measure(0, 1, dimensions)
    check("control: a domain of 0 to 1 is exact in both", close(f, v) and close(o, v))
    for low, high in ((-0.5, 1.5), (-0.073, 1.095)):
        f, o = measure(low, high, dimensions)
        check(f"control: OpenColorIO keeps the values, {dimensions}D {low} to {high}", close(o, v))
        check(f"ffmpeg adds DOMAIN_MIN to every value, {dimensions}D {low} to {high}", close(f, v + low))
f, o = measure(0, 2)
check("a domain of 0 to 2 works in ffmpeg", close(f, v) and close(o, v))
f, o = measure(0, 0.5)
check("control: OpenColorIO keeps 0.25 and clamps at 0.5", close(o, np.minimum(v, 0.5)))
check("ffmpeg halves every value where the domain is 0 to 0.5", close(f, v / 2))
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
