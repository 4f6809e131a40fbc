#!/usr/bin/env bash
# A DPX written by ffmpeg is read sheared by OpenImageIO, without an error, if a row is no multiple of four bytes
#
# Tools    ffmpeg 5.1.9 (Debian 7:5.1.9-0+deb12u1), OpenImageIO 2.4.7 (2.4.7.1+dfsg-2)
# Date     2026-11-30
# Guess    Both have read and written DPX for over a decade, and its header says how long a row is (end-of-line padding):
#          what one writes the other reads.
# Seen     ffmpeg fills each row up to four bytes and states a padding of 0 in the header; OpenImageIO believes the 0.
#          Each row then starts too early, and colours change places from row to row. Pixels that are wrong:
#            1920 x 1080,  8 bit RGB     0.0 %
#            1996 x 1080,  8 bit RGB     0.0 %
#            1998 x 1080,  8 bit RGB    99.9 %    1998 is the width of a flat 2K picture
#            1998 x 1080, 16 bit RGB     0.0 %
#            1919 x 1080, 16 bit RGB    99.9 %
#          Nothing is reported. ffmpeg reads its own file back bit for bit, and OpenImageIO's, which has no
#          filling, too; so each program's round trip is right.
# Matters  Plates are transcoded by ffmpeg and read by compositors and tools that are built on OpenImageIO. Tests are
#          made at 1920 and 2048, where it works; a crop or the flat container then gives a plate of diagonal stripes.
# Do       Write plates as 10 bit DPX, or EXR, or 16 bit at even widths; or tell by the file's size: a file that is longer
#          than header and rows by height times the filling is a filled one.
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
need libopenimageio2.4 2.4.7.1+dfsg-2
need python3-openimageio 2.4.7.1+dfsg-2
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import struct, subprocess, sys
import numpy as np
import OpenImageIO as oiio

failed = []
def check(what, ok):
    if not ok: failed.append(what)

def by_ffmpeg(name, pixel_format):
    return subprocess.run(["ffmpeg", "-v", "error", "-i", name, "-f", "rawvideo", "-pix_fmt", pixel_format, "-"],
                          stdout=subprocess.PIPE, check=True).stdout

def measure(width, bits, height=1080):
    dtype, pixel_format, kind = ("u1", "rgb24", "uint8") if bits == 8 else ("<u2", "rgb48le", "uint16")
    pixels = np.random.default_rng(1).integers(0, 1 << bits, (height, width, 3)).astype(dtype)
    name = f"ffmpeg_{width}_{bits}.dpx"
    subprocess.run(["ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", pixel_format, "-s", f"{width}x{height}",
                    "-i", "-", "-frames:v", "1", name], input=pixels.tobytes(), check=True)
    data = open(name, "rb").read()
    order = ">" if data[:4] == b"SDPX" else "<"
    start, = struct.unpack(order + "I", data[4:8])
    padding, = struct.unpack(order + "I", data[812:816])  # end-of-line padding of the first image element
    row, filled = width * 3 * bits // 8, -(-width * 3 * bits // 32) * 4
    # By hand, with rows of a multiple of four bytes: are the pixels in the file as they should be?
    stored = np.frombuffer(data, "u1", filled * height, start).reshape(height, filled)[:, :row]
    stored = np.ascontiguousarray(stored).view("u1" if bits == 8 else order + "u2").reshape(height, width, 3)
    check(f"control: the rows in {name} have {filled} bytes and are right", bool((stored == pixels).all()))
    check(f"the header of {name} states a padding of 0", padding == 0)
    check(f"control: ffmpeg reads {name} back", by_ffmpeg(name, pixel_format) == pixels.tobytes())
    file = oiio.ImageInput.open(name)
    read = np.asarray(file.read_image(kind)).reshape(height, width, -1)
    file.close()
    wrong = 100 * float((read != pixels).any(axis=2).mean())
    print(f"{width} x {height}, {bits:2} bit: row {row} bytes, in the file {filled}, header says padding {padding};"
          f" OpenImageIO reads {wrong:.1f} % of the pixels wrong")
    # The other way round
    name = f"oiio_{width}_{bits}.dpx"
    out = oiio.ImageOutput.create(name)
    assert out.open(name, oiio.ImageSpec(width, height, 3, kind)) and out.write_image(pixels) and out.close()
    check(f"control: ffmpeg reads {name}", by_ffmpeg(name, pixel_format) == pixels.tobytes())
    return wrong

check("1920, 8 bit: right (a control)", measure(1920, 8) == 0)
check("1996, 8 bit: right (a control)", measure(1996, 8) == 0)
check("1998, 8 bit: sheared", measure(1998, 8) > 99)
check("1998, 16 bit: right (a control)", measure(1998, 16) == 0)
check("1919, 16 bit: sheared", measure(1919, 16) > 99)
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
