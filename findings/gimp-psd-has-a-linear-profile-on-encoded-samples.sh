#!/usr/bin/env bash
# GIMP 2.10 writes display-encoded samples into a PSD and puts a linear profile on them
#
# Tools    GIMP 2.10.34 (Debian 2.10.34-1+deb12u10); judged by littleCMS 2.14 (2.14-2) through Pillow 9.4.0
# Date     2026-11-30
# Guess    A picture in linear light (every EXR is one in GIMP) is exported as PSD with samples and an ICC profile that
#          agree, as in PNG and TIFF: linear samples with the linear profile, or encoded samples with GIMP's sRGB.
# Seen     Linear light of 0.2667, and what a reader shows that believes the profile (lcms, to sRGB, then to linear):
#            export from                     sample    profile        shown light
#            linear precision, PNG           0.2667    linear sRGB    0.266
#            linear precision, PSD           0.5532    linear sRGB    0.552    twice as bright
#            non-linear precision, PSD       0.5532    sRGB           0.266
#          GIMP reads the bright file back as 0.2667: it makes the same mistake the other way, so a look at the export in
#          GIMP says that all is well.
# Matters  A PSD is how a painted texture goes from GIMP to another paint program, or to a renderer that honours
#          profiles: it arrives twice as bright in the middle tones, from GIMP alone and only if the picture was linear.
# Do       Before the export: Image > Precision > Perceptual gamma (sRGB); or use PNG, TIFF or EXR. A reader of PSD files
#          can tell GIMP's built-in linear profile by its name and take such samples as encoded.
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
need liblcms2-2 2.14-2
need python3-pil 9.4.0-1.1+deb12u1
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
image = oiio.ImageBuf(oiio.ImageSpec(16, 16, 3, "float"))
image.set_pixels(oiio.ROI(), np.full((16, 16, 3), 4 / 15, np.float32))
assert image.write("in.exr")
PY
# Precisions of GIMP's procedure: 200 is 16 bit integer linear, 250 the same with the curve of sRGB.
cat > batch.scm <<SCM
(define (through from to precision)
  (let ((image (car (gimp-file-load RUN-NONINTERACTIVE from from))))
    (if (> precision 0) (gimp-image-convert-precision image precision))
    (gimp-file-save RUN-NONINTERACTIVE image (car (gimp-image-get-active-drawable image)) to to)
    (gimp-image-delete image)))
(through "$tmp/in.exr" "$tmp/linear.psd" 200)
(through "$tmp/in.exr" "$tmp/as_opened.psd" 0)
(through "$tmp/in.exr" "$tmp/perceptual.psd" 250)
(through "$tmp/in.exr" "$tmp/linear.png" 200)
(through "$tmp/linear.psd" "$tmp/back.exr" 0)
(gimp-quit 0)
SCM
timeout 300 gimp -i -d -f -b - <batch.scm >gimp.log 2>&1 || { cat gimp.log; exit 1; }
/usr/bin/python3 - <<'PY'
import io, struct, sys
import numpy as np
import OpenImageIO as oiio
from PIL import Image, ImageCms

def psd_profile(name):
    """Resource 1039 of a PSD, read by hand: no library between the file and the measurement."""
    data = open(name, "rb").read()
    at = 26 + 4 + struct.unpack(">I", data[26:30])[0]
    end = at + 4 + struct.unpack(">I", data[at:at + 4])[0]
    at += 4
    while at < end:
        assert data[at:at + 4] == b"8BIM"
        number, length = struct.unpack(">HB", data[at + 4:at + 7])
        at += 7 + length + (length + 1) % 2
        size = struct.unpack(">I", data[at:at + 4])[0]
        if number == 1039: return data[at + 4:at + 4 + size]
        at += 4 + size + size % 2
    raise SystemExit("no profile in " + name)

def sample(name):
    file = oiio.ImageInput.open(name)
    pixels = np.asarray(file.read_image("float")).reshape(16, 16, -1)
    file.close()
    return float(pixels[8, 8, 0])

def shown_light(value, profile):
    """Linear light of what a colour managed reader shows (through 8 bits)."""
    source = ImageCms.ImageCmsProfile(io.BytesIO(profile))
    picture = Image.new("RGB", (1, 1), (round(value * 255),) * 3)
    out = ImageCms.profileToProfile(picture, source, ImageCms.createProfile("sRGB"), renderingIntent=1)
    v = out.getpixel((0, 0))[1] / 255
    return ((v + 0.055) / 1.055) ** 2.4 if v > 0.04045 else v / 12.92

failed = []
def measure(name, profile, expected_sample, expected_light, linear, control):
    value = sample(name)
    light = shown_light(value, profile)
    title = ImageCms.getProfileDescription(ImageCms.ImageCmsProfile(io.BytesIO(profile))).strip()
    print(f"{name:15} sample {value:.4f}, profile '{title}', shown light {light:.3f}")
    if abs(value - expected_sample) > 0.003 or abs(light - expected_light) > 0.01 or ("inear" in title) != linear:
        failed.append(name + (" (a control)" if control else ""))

png = Image.open("linear.png").info["icc_profile"]
measure("linear.png", png, 0.2667, 0.267, True, True)
measure("perceptual.psd", psd_profile("perceptual.psd"), 0.5532, 0.267, False, True)
measure("linear.psd", psd_profile("linear.psd"), 0.5532, 0.553, True, False)
measure("as_opened.psd", psd_profile("as_opened.psd"), 0.5532, 0.553, True, False)
back = sample("back.exr")
print(f"linear.psd opened in GIMP again and exported as EXR: {back:.4f}")
if abs(back - 0.2667) > 0.001: failed.append("GIMP reads its own file back as 0.2667")
for what in failed: print("CHANGED:", what)
sys.exit(1 if failed else 0)
PY
