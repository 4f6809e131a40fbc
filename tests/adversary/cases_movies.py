"""Plates as movies: containers, codecs, rates, colour tags, interlace, sound alone; and review movies that Weft writes."""
import os

from cases import add, frames
from oracle import OK, UNREADABLE, USAGE, Output, Step


EITHER = (OK, UNREADABLE)
X264 = ("-c:v", "libx264", "-preset", "ultrafast")


def movie(name, options, filters=None, count=3, rate="24", exits=(OK,), says=(), more=(), picture=False, size=None, numbers=None):
    def build(shot):
        shot.movie(name, *options, filters=filters, count=count, rate=rate)
        if size:
            shot.ordinary(size=size, numbers=shot.numbers, plates=None)
        if numbers:
            shot.ordinary(size=shot.size, numbers=numbers, plates=None)
        outputs = frames(shot, picture=picture, tolerance=8)
        yield Step(shot.replace(*more, plate=name), exits=exits, says=says, outputs=outputs)
    return build


for _name, _options in {
        "h264.mp4": (*X264, "-pix_fmt", "yuv420p"), "h264_444.mp4": (*X264, "-pix_fmt", "yuv444p"),
        "h264_b_frames.mkv": (*X264, "-pix_fmt", "yuv420p", "-bf", "2", "-g", "3"), "h264.mov": (*X264, "-pix_fmt", "yuv420p"),
        "h264.avi": (*X264, "-pix_fmt", "yuv420p"), "h264_10_bits.mkv": (*X264, "-pix_fmt", "yuv420p10le"),
        "hevc.mp4": ("-c:v", "libx265", "-preset", "ultrafast", "-x265-params", "log-level=0", "-pix_fmt", "yuv420p"),
        "ffv1.mkv": ("-c:v", "ffv1"), "ffv1_16.mkv": ("-c:v", "ffv1", "-pix_fmt", "gbrp16le"), "prores.mov": ("-c:v", "prores_ks"),
        "prores_4444.mov": ("-c:v", "prores_ks", "-profile:v", "4", "-pix_fmt", "yuva444p10le"), "dnxhr.mov": (
            "-c:v", "dnxhd", "-profile:v", "dnxhr_hq", "-pix_fmt", "yuv422p", "-s", "256x128"),
        "mjpeg.avi": ("-c:v", "mjpeg", "-pix_fmt", "yuvj444p"), "mpeg4.avi": ("-c:v", "mpeg4"), "mpeg2.mpg": ("-c:v", "mpeg2video"),
        "raw.avi": ("-c:v", "rawvideo", "-pix_fmt", "bgr24"), "huffyuv.avi": ("-c:v", "huffyuv"), "png.mov": ("-c:v", "png"),
        "png_16.mov": ("-c:v", "png", "-pix_fmt", "rgb48be"), "animation.mov": ("-c:v", "qtrle"), "vp9.webm": ("-c:v", "libvpx-vp9",),
        "grey.mkv": ("-c:v", "ffv1", "-pix_fmt", "gray"), "animated.gif": (), "transport.ts": X264}.items():
    _size = (256, 128) if "dnxhr" in _name else None
    _known = _name.rsplit(".")[-1] in ("mp4", "mkv", "mov", "avi")
    add("movie/" + _name, movie(_name, _options, exits=(OK,) if _known else EITHER + (USAGE,), size=_size,
                                picture=_name in ("ffv1.mkv", "png.mov", "raw.avi")))

for _rate in ("1", "23.976", "24000/1001", "25", "29.97", "59.94", "120", "1000/7"):
    add("movie/rate_" + _rate.replace("/", "_"), movie("a.mkv", ("-c:v", "ffv1"), rate=_rate,
                                                       more=("--movie", "out/review.mp4")))
add("movie/one_frame", movie("a.mp4", (*X264, "-pix_fmt", "yuv420p"), count=1))
add("movie/twelve_frames", movie("a.mp4", (*X264, "-pix_fmt", "yuv420p"), count=12))
add("movie/odd_size", movie("a.mkv", ("-c:v", "ffv1"), filters="scale=63:47", size=(63, 47)))
add("movie/tiny", movie("a.mkv", ("-c:v", "ffv1"), filters="scale=2:2", size=(2, 2)))
add("movie/variable_rate", movie("a.mkv", ("-c:v", "ffv1", "-vsync", "vfr"), filters="setpts='N*N*0.07/TB'", count=6, rate="1000",
                                 exits=EITHER, says=("rate|variable",)))
add("movie/long_gap", movie("a.mkv", ("-c:v", "ffv1", "-vsync", "vfr"), filters="setpts='(N+gte(N,2)*50)*0.04/TB'", count=4, rate="1000",
                            exits=EITHER, says=("rate|variable",)))
add("movie/flagged_interlaced", movie("a.mkv", ("-c:v", "mpeg2video", "-flags", "+ildct+ilme", "-top", "1"), filters="setfield=tff",
                                      exits=EITHER, says=("[Ii]nterlace",)))
for _name, _tags in {"pq": ("bt2020", "smpte2084", "bt2020nc"), "hlg": ("bt2020", "arib-std-b67", "bt2020nc"),
                     "bt601": ("smpte170m", "smpte170m", "smpte170m"), "linear": ("bt709", "linear", "bt709"),
                     "p3": ("smpte432", "bt709", "bt709"), "unknown": ("unknown", "unknown", "unknown")}.items():
    add("movie/tags_" + _name, movie("a.mkv", ("-c:v", "ffv1", "-pix_fmt", "yuv444p10le", "-color_primaries", _tags[0], "-color_trc",
                                               _tags[1], "-colorspace", _tags[2]), exits=EITHER))
add("movie/full_range", movie("a.mp4", (*X264, "-pix_fmt", "yuvj420p", "-color_range", "pc")))
add("movie/rotated", movie("a.mp4", (*X264, "-pix_fmt", "yuv420p", "-metadata:s:v:0", "rotate=90"), exits=EITHER, size=None))
add("movie/pixel_aspect", movie("a.mp4", (*X264, "-pix_fmt", "yuv420p"), filters="setsar=2/1"))
for _start in ("0", "-5", "2147483640", "2147483647", "99999999999"):
    add("movie/start_" + _start, movie(
        "a.mkv", ("-c:v", "ffv1"), more=("--movie-start", _start), exits=(OK, USAGE),
        numbers=range(int(_start), int(_start) + 3) if abs(int(_start)) < 2147483645 else None))


def hostile(name, make, exits=(UNREADABLE,), says=()):
    def build(shot):
        shot.ordinary(numbers=range(1001, 1004), plates="source/{}.png")
        make(shot)
        yield Step(shot.replace(plate=name), exits=exits, says=says)
    return build


def sound(shot, name, *codec):
    shot.tool("ffmpeg", "-v", "error", "-f", "lavfi", "-i", "sine=d=0.2", *codec, name)


def damaged(name, change):
    def make(shot):
        shot.movie(name, *X264, "-pix_fmt", "yuv420p", count=3)
        data = bytearray(shot.get(name))
        shot.put(name, bytes(change(shot, data)))
    return make


def flipped(shot, data):
    for _ in range(40):
        data[shot.chance.randrange(len(data))] ^= 1 << shot.chance.randrange(8)
    return data


add("movie/sound_alone.mp4", hostile("a.mp4", lambda s: sound(s, "a.mp4", "-c:a", "aac"), says=("sound|audio|picture|video",)))
add("movie/sound_alone.mkv", hostile("a.mkv", lambda s: sound(s, "a.mkv", "-c:a", "flac"), says=("sound|audio|picture|video",)))
add("movie/sound_alone.wav", hostile("a.wav", lambda s: sound(s, "a.wav"), EITHER + (USAGE,)))
add("movie/text", hostile("a.mp4", lambda s: s.put("a.mp4", "this is no movie\n" * 50)))
add("movie/empty", hostile("a.mp4", lambda s: s.put("a.mp4", b"")))
add("movie/png_named_mp4", hostile("a.mp4", lambda s: s.put("a.mp4", s.get("tile.png")), EITHER))
add("movie/playlist_named_mp4", hostile("a.mp4", lambda s: s.put(
    "a.mp4", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nfile:///etc/passwd\n#EXT-X-ENDLIST\n")))
add("movie/concat_named_mkv", hostile("a.mkv", lambda s: s.put("a.mkv", "ffconcat version 1.0\nfile source/1001.png\n")))
for _kind in ("mp4", "mkv", "mov", "avi"):
    for _index in range(3):
        add(f"movie/flipped{_index}.{_kind}", hostile("a." + _kind, damaged("a." + _kind, flipped), EITHER + (4,)))
    add(f"movie/half.{_kind}", hostile("a." + _kind, damaged("a." + _kind, lambda s, d: d[:len(d) // 2]), EITHER + (4,)))
    add(f"movie/head_alone.{_kind}", hostile("a." + _kind, damaged("a." + _kind, lambda s, d: d[:100]), (UNREADABLE,)))


def written(name, options=(), exits=(OK,), size=(64, 48), rate=(), played=None):
    """A review movie of Weft's own, beside the frames."""
    def build(shot):
        shot.ordinary(size=size)
        even = (size[0] + size[0] % 2, size[1] + size[1] % 2) if name.endswith(".mp4") else size
        yield Step(shot.replace("--movie", name, *options, *rate), exits=exits,
                   outputs=frames(shot) + [Output(name, size=even, frames=3)])
        if 0 in exits:
            assert os.path.exists(shot.path(name))
            yield Step(shot.replace("--movie", name, *options), exits=(USAGE,))
            yield Step(shot.replace("--movie", name, *options, "--overwrite"), outputs=[Output(name, size=even, frames=3)])
    return build


for _extension in ("mp4", "mkv"):
    for _size in ((64, 48), (63, 47), (15, 17)):
        add(f"review/{_size[0]}x{_size[1]}.{_extension}", written("out/review." + _extension, size=_size))
    add("review/burn_in." + _extension, written("out/review." + _extension, ("--burn-in",)))
    for _rate in ("0", "23.976", "1000"):
        add(f"review/fps{_rate}.{_extension}", written("out/review." + _extension, rate=("--fps", _rate)))
for _name in ("out/review.mov", "out/review.avi", "out/review", "out/review.png", "out/r####.mp4", ""):
    add(f"review/named_{_name.replace('/', '_') or 'nothing'}", written(_name, exits=(OK, USAGE) if _name in ("", "out/r####.mp4") else
                                                                        (USAGE,)) if _name not in ("", "out/r####.mp4") else
        lambda shot, n=_name: iter([Step(shot.ordinary().replace("--movie", n), exits=(OK, USAGE))]))
for _value in ("nan", "inf", "-1", "1e30", "0.0001", "abc"):
    add("review/fps_" + _value, lambda shot, v=_value: iter([Step(
        shot.ordinary().replace("--movie", "out/r.mp4", "--fps", v), exits=(USAGE,) if v != "0.0001" else (OK, USAGE))]))
