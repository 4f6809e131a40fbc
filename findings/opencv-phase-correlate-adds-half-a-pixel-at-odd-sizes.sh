#!/usr/bin/env bash
# OpenCV's phaseCorrelate says that a picture is half a pixel off from itself, where the transform's size is odd
#
# Tools    OpenCV 4.6.0 (Debian python3-opencv 4.6.0+dfsg-12)
# Date     2026-11-30
# Guess    The shift between a picture and itself is (0, 0) at every size; the response tells how sure it is.
# Seen     phaseCorrelate(a, a) for noise, width x height (x, y), response 1.0 each time:
#              64 x 64     0.0, 0.0           25 x 25     0.5, 0.5
#             127 x 127    0.0, 0.0           75 x 75     0.5, 0.5
#            1920 x 1080   0.0, 0.0         1125 x 1125   0.5, 0.5
#              64 x 75     0.0, 0.5         1875 x 1080   0.5, 0.0
#          The picture is padded to the next length that the transform does fast (127 to 128), so most odd sizes are
#          right, and those that are odd products of 3 and 5 (15, 25, 27, 45, 75, 81, 125, 225, 1125, 1875 …) are not: the
#          peak is in whole pixels, the middle that it is measured from is size / 2. A true shift of 3 is then 3.5.
# Matters  Windows of trackers are odd on purpose (15, 25, 45, 75). The error is constant, with full confidence, below the
#          pixel at which a test of "found within 1 px" looks; summed from frame to frame it is a drift of half a pixel
#          each: 12 px in a second of film.
# Do       Use even sizes, or subtract what phaseCorrelate(a, a) says for the size; measure a tracker on standing pictures.
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
need python3-opencv 4.6.0+dfsg-12
need libopencv-imgproc406 4.6.0+dfsg-12
need python3-numpy 1:1.24.2-1+deb12u1

tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp"
/usr/bin/python3 - <<'PY'
import sys
import cv2
import numpy as np

failed = []
def check(what, ok):
    if not ok: failed.append(what)

def by_numpy(a, b):
    """The same method in a few lines, without any padding: whole pixels."""
    cross = np.conj(np.fft.fft2(a)) * np.fft.fft2(b)
    peak = np.fft.ifft2(cross / np.maximum(np.abs(cross), 1e-12)).real
    y, x = np.unravel_index(peak.argmax(), peak.shape)
    return [int(v - n if v > n // 2 else v) for v, n in ((x, a.shape[1]), (y, a.shape[0]))]

for width, height in ((64, 64), (127, 127), (1920, 1080), (64, 75), (15, 27), (25, 25), (45, 81), (75, 75), (225, 125), (1125, 1125), (1875, 1080)):
    a = np.random.default_rng(1).random((height, width))
    moved = np.roll(a, (2, 3), (0, 1))  # 3 to the right, 2 down, around the edge: nothing is lost
    padded = [cv2.getOptimalDFTSize(n) for n in (width, height)]
    expected = [0.5 if n % 2 else 0.0 for n in padded]
    still, response = cv2.phaseCorrelate(a, a)
    print(f"{width:4} x {height:4} (transform {padded[0]} x {padded[1]}): itself {still[0]:.3f}, {still[1]:.3f}"
          f" (response {response:.3f})", end="")
    check(f"{width} x {height}: itself is off by {expected}", np.abs(np.subtract(still, expected)).max() < 1e-3 and response > 0.99)
    check(f"control: {width} x {height} by numpy", by_numpy(a, a) == [0, 0] and by_numpy(a, moved) == [3, 2])
    if padded == [width, height]:  # where nothing is padded, a wrapped shift has one sharp peak
        shift, _ = cv2.phaseCorrelate(a, moved)
        print(f", moved by 3, 2: {shift[0]:.3f}, {shift[1]:.3f}", end="")
        check(f"{width} x {height}: moved", np.abs(np.subtract(shift, (3 + expected[0], 2 + expected[1]))).max() < 1e-3)
    print()
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
