"""EXR, DPX, JPEG and TIFF files that common programs do not write, made byte by byte."""
import struct

UINT, HALF, FLOAT = 0, 1, 2
SAMPLE = {UINT: "I", HALF: "e", FLOAT: "f"}


def exr_attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def exr(channels, data_window, display_window=None, extra=b"", line_order=0):
    """An uncompressed scan line EXR. channels: name -> (type, x sampling, y sampling, value(x, y)); windows: x0, y0, x1, y1,
    all included."""
    x0, y0, x1, y1 = data_window
    names = sorted(channels)
    listed = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", channels[n][0], 0, *channels[n][1:3]) for n in names)
    header = struct.pack("<II", 20000630, 2)
    header += exr_attribute("channels", "chlist", listed + b"\0")
    header += exr_attribute("compression", "compression", b"\0")
    header += exr_attribute("dataWindow", "box2i", struct.pack("<4i", *data_window))
    header += exr_attribute("displayWindow", "box2i", struct.pack("<4i", *(display_window or data_window)))
    header += exr_attribute("lineOrder", "lineOrder", bytes([line_order]))
    header += exr_attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += exr_attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += exr_attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    header += extra + b"\0"
    lines = []
    for y in range(y0, y1 + 1):
        data = b""
        for n in names:
            kind, sx, sy, value = channels[n]
            if y % sy == 0:
                row = [value(x, y) for x in range(x0, x1 + 1) if x % sx == 0]
                data += struct.pack(f"<{len(row)}{SAMPLE[kind]}", *row)
        lines.append(struct.pack("<ii", y, len(data)) + data)
    order = range(len(lines)) if line_order == 0 else range(len(lines) - 1, -1, -1)
    offsets, body, at = {}, b"", len(header) + 8 * len(lines)
    for i in order:
        offsets[i] = at + len(body)
        body += lines[i]
    return header + struct.pack(f"<{len(lines)}Q", *(offsets[i] for i in range(len(lines)))) + body


def dpx(rows, bits, big=True, transfer=2, fps=24.0, packing=1, timecode=0xFFFFFFFF):
    """rows: lists of (r, g, b) with 0 to 1. transfer: 1 printing density, 2 linear, 3 log, 4 unspecified video, 6 Rec. 709."""
    e, height, width = ">" if big else "<", len(rows), len(rows[0])
    head = bytearray(b"\xff" * 2048)
    struct.pack_into(e + "4sI8s", head, 0, b"SDPX" if big else b"XPDS", 2048, b"V1.0\0\0\0\0")
    largest = (1 << bits) - 1
    body = bytearray()
    for row in rows:
        codes = [round(max(0.0, min(1.0, v)) * largest) for p in row for v in p]
        if bits == 8:
            body += bytes(codes)
            body += b"\0" * (-len(codes) % 4)
        elif bits == 10:
            for i in range(0, len(codes), 3):
                r, g, b = codes[i:i + 3]
                body += struct.pack(e + "I", r << 22 | g << 12 | b << 2)
        elif bits == 12:
            body += struct.pack(f"{e}{len(codes)}H", *(c << 4 for c in codes))
            body += b"\0" * (-2 * len(codes) % 4)
        else:
            body += struct.pack(f"{e}{len(codes)}H", *codes)
            body += b"\0" * (-2 * len(codes) % 4)
    struct.pack_into(e + "IIIII", head, 16, 2048 + len(body), 1, 1664, 384, 0)
    struct.pack_into("100s", head, 36, b"plate.dpx")
    struct.pack_into(e + "HHII", head, 768, 0, 1, width, height)
    struct.pack_into(e + "IIfIfBBBBHHIII", head, 780, 0, 0, 0.0, largest, 2.047, 50, transfer, 2, bits,
                     packing if bits in (10, 12) else 0, 0, 2048, 0, 0)
    struct.pack_into(e + "f", head, 1724, fps)
    struct.pack_into(e + "I", head, 1920, timecode)
    struct.pack_into(e + "f", head, 1940, fps)
    return bytes(head + body)


class _Bits:
    def __init__(self):
        self.data, self.value, self.filled = bytearray(), 0, 0

    def put(self, value, count):
        for i in range(count - 1, -1, -1):
            self.value, self.filled = self.value << 1 | (value >> i & 1), self.filled + 1
            if self.filled == 8:
                self.data += bytes([self.value, 0]) if self.value == 255 else bytes([self.value])
                self.value, self.filled = 0, 0

    def end(self):
        while self.filled:
            self.put(1, 1)
        return bytes(self.data)


def exif_orientation(value, big=False):
    """The payload of an APP1 marker."""
    e = ">" if big else "<"
    tiff = struct.pack(e + "2sHI", b"MM" if big else b"II", 42, 8)
    tiff += struct.pack(e + "HHHIHHI", 1, 0x0112, 3, 1, value, 0, 0)
    return b"Exif\0\0" + tiff


def jpeg(blocks, progressive=False, adobe=None, exif=None, precision=8):
    """A JPEG of flat blocks of 8×8. blocks: rows of tuples, one value from 0 to 255 a component (1 grey, 3 YCbCr, 4 CMYK).
    adobe: the transform of an Adobe marker (0 CMYK, 2 YCCK). A progressive one has its DC scan alone."""
    count = len(blocks[0][0])

    def marker(code, data):
        return bytes([255, code]) + struct.pack(">H", len(data) + 2) + data

    out = b"\xff\xd8"
    if adobe is not None:
        out += marker(0xEE, b"Adobe" + struct.pack(">HHHB", 100, 0, 0, adobe))
    if exif is not None:
        out += marker(0xE1, exif)
    out += marker(0xDB, b"\0" + bytes([8] + [1] * 63))
    parts = b"".join(bytes([i + 1, 0x11, 0]) for i in range(count))
    out += marker(0xC2 if progressive else 0xC0,
                  struct.pack(">BHHB", precision, 8 * len(blocks), 8 * len(blocks[0]), count) + parts)
    # Twelve DC categories with codes of four bits each; one AC code, the end of the block.
    out += marker(0xC4, b"\0" + bytes([0, 0, 0, 12] + [0] * 12) + bytes(range(12)))
    out += marker(0xC4, b"\x10" + bytes([1] + [0] * 15) + b"\0")
    scan = bytes([count]) + b"".join(bytes([i + 1, 0]) for i in range(count))
    out += marker(0xDA, scan + (b"\0\0\0" if progressive else b"\0\x3f\0"))
    bits, before = _Bits(), [0] * count
    for row in blocks:
        for block in row:
            for i, value in enumerate(block):
                step, before[i] = value - 128 - before[i], value - 128
                size = abs(step).bit_length()
                bits.put(size, 4)
                bits.put(step if step >= 0 else step + (1 << size) - 1, size)
                if not progressive:
                    bits.put(0, 1)
    return out + bits.end() + b"\xff\xd9"


def tiff(rows, photometric=2, bits=8, orientation=1, big=False, extra_tags=(), planar=1):
    """An uncompressed TIFF of one strip. rows: lists of samples. photometric: 0 white is 0, 1 grey, 2 RGB, 3 palette, 5 CMYK."""
    e = ">" if big else "<"
    channels = {0: 1, 1: 1, 2: 3, 3: 1, 5: 4}[photometric]
    width, height = len(rows[0]) // channels, len(rows)
    if bits == 16:
        data = b"".join(struct.pack(f"{e}{len(r)}H", *r) for r in rows)
    else:
        data = b"".join(bytes(r) for r in rows)
    tags = {256: (3, [width]), 257: (3, [height]), 258: (3, [bits] * channels), 259: (3, [1]), 262: (3, [photometric]),
            273: (4, [8]), 274: (3, [orientation]), 277: (3, [channels]), 278: (3, [height]), 279: (4, [len(data)]),
            284: (3, [planar])}
    if photometric == 3:
        tags[320] = (3, [257 * (i % 256) for i in range(256)] * 3)
    tags.update(extra_tags)
    at = 8 + len(data) + len(data) % 2
    entries, tail, after = b"", b"", at + 2 + 12 * len(tags) + 4
    for tag in sorted(tags):
        kind, values = tags[tag]
        packed = struct.pack(f"{e}{len(values)}{'H' if kind == 3 else 'I'}", *values)
        if len(packed) > 4:
            entries += struct.pack(e + "HHII", tag, kind, len(values), after + len(tail))
            tail += packed
        else:
            entries += struct.pack(e + "HHI", tag, kind, len(values)) + packed.ljust(4, b"\0")
    head = struct.pack(e + "2sHI", b"MM" if big else b"II", 42, at)
    return head + data + b"\0" * (len(data) % 2) + struct.pack(e + "H", len(tags)) + entries + b"\0\0\0\0" + tail
