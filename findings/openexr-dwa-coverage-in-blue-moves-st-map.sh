#!/usr/bin/env bash
# OpenEXR's DWAA bends an ST-map by 61 pixels because coverage stands in B; under other channel names it is exact
#
# Tools    OpenEXR 3.1.5 (Debian libopenexr-3-1-30 3.1.5-5), through OpenImageIO 2.4.7 (2.4.7.1+dfsg-2)
# Date     2026-11-30
# Guess    DWAA is lossy, so an ST-map suffers, alike whatever its channels are called and whatever else is in the file:
#          each channel is compressed by itself.
# Seen     A smooth map of 32-bit floats over 4096 pixels, and a disc of coverage; DWAA at its default level. Error of
#          the look-up inside of the disc, where it is used:
#            channels                       largest   mean
#            R, G                            3.5 px   1.1 px
#            R, G, and coverage in A         3.5 px   1.1 px  (A is lossless)
#            R, G, and zeros in B            6.5 px   1.5 px
#            R, G, and coverage in B        61.5 px   2.4 px  (and the coverage is off by 0.018)
#            r, g, and coverage in b         0.00 px          (bit for bit: lossless)
#            U, V, and coverage in A         0.00 px          (bit for bit)
#            X, Y                            X bit for bit, Y lossy
#          R, G and B of a layer are turned to luma and chroma together before the cosine transform, so the steps of the
#          coverage ring into both coordinates; and what is lossy at all is decided by the channel's name, where the
#          case of the letter counts.
# Matters  ST-maps (and object coordinates) travel as R, G, and Blender's Map UV takes the coverage from B. A pipeline
#          that keeps all of its EXR files as DWAA, with a level that nobody sees in a beauty pass, bends the texture
#          along the rim of every matte by tens of pixels.
# Do       Keep ST-maps, coordinates and depth (Y) in files or parts with a lossless compression. Where DWAA is forced,
#          name the channels U and V and the coverage A. Never judge a compression by the beauty.
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
need libopenexr-3-1-30 3.1.5-5
need python3-openimageio 2.4.7.1+dfsg-2
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import sys
import numpy as np
import OpenImageIO as oiio

W, H = 4096, 256
x, y = np.meshgrid(np.arange(W) + 0.5, np.arange(H) + 0.5)
inside = (x - 2048) ** 2 + (y - 128) ** 2 < 100 ** 2
data = {"s": (x / W).astype(np.float32), "t": (y / H).astype(np.float32),
        "coverage": inside.astype(np.float32), "zeros": np.zeros((H, W), np.float32)}

def through(channels, compression):
    """What comes back of the channels, by name."""
    spec = oiio.ImageSpec(W, H, len(channels), "float")
    spec.channelnames = tuple(channels)
    spec["compression"] = compression
    out = oiio.ImageOutput.create("map.exr")
    assert out.open("map.exr", spec) and out.write_image(np.dstack([data[d] for d in channels.values()])) and out.close()
    file = oiio.ImageInput.open("map.exr")
    names = file.spec().channelnames
    assert file.spec()["compression"].startswith(compression)
    pixels = np.asarray(file.read_image("float")).reshape(H, W, -1)
    file.close()
    return {n: pixels[..., i] for i, n in enumerate(names)}

failed = []
def check(what, ok):
    if not ok: failed.append(what)

def error(channels, compression="dwaa"):
    """Largest and mean error of the look-up in pixels, and the largest error of the coverage."""
    got = through(channels, compression)
    off = {d: np.abs(got[n] - data[d]) for n, d in channels.items()}
    s, t = off["s"][inside] * W, off["t"][inside] * H
    cover = float(off["coverage"].max()) if "coverage" in off else 0.0
    print(f"{compression:4} {' '.join(f'{n}={d}' for n, d in channels.items()):24} s: largest {s.max():6.2f} px, mean"
          f" {s.mean():5.2f} px; t: largest {t.max():5.2f} px; coverage off by {cover:.4f}")
    return float(s.max()), float(s.mean()), float(t.max()), cover

exact = (0.0, 0.0, 0.0, 0.0)
rg = {"R": "s", "G": "t"}
check("control: zip keeps R, G, B bit for bit", error({**rg, "B": "coverage"}, "zip") == exact)
check("control: so does piz", error({**rg, "B": "coverage"}, "piz") == exact)
alone, mean, _, _ = error(rg)
check("R and G alone: largest error about 3.5 px", 3 < alone < 4 and 0.9 < mean < 1.3)
with_a, _, _, cover = error({**rg, "A": "coverage"})
check("coverage in A changes nothing and is kept exactly", with_a == alone and cover == 0)
zeros, _, _, _ = error({**rg, "B": "zeros"})
check("zeros in B: about 6.5 px", 6 < zeros < 7)
with_b, _, _, cover = error({**rg, "B": "coverage"})
check("coverage in B: about 61 px, and lossy itself", 55 < with_b < 68 and cover > 0.01)
check("lower-case r, g, b are exact", error({"r": "s", "g": "t", "b": "coverage"}) == exact)
check("U, V, A are exact", error({"U": "s", "V": "t", "A": "coverage"}) == exact)
s, _, t, _ = error({"X": "s", "Y": "t"})
check("of X and Y only Y is lossy", s == 0 and t > 0)
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
