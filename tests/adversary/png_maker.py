"""PNG files of every bit depth, colour type and interlace, written without Weft's libraries."""
import struct
import zlib

GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6
CHANNELS = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}
PASSES = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def packed(row, bits):
    """The bytes of one row of samples."""
    if bits == 16:
        return struct.pack(f">{len(row)}H", *row)
    if bits == 8:
        return bytes(row)
    out, value, filled = bytearray(), 0, 0
    for sample in row:
        value, filled = value << bits | sample, filled + bits
        if filled == 8:
            out.append(value)
            value, filled = 0, 0
    if filled:
        out.append(value << (8 - filled))
    return bytes(out)


def encode(rows, bits=8, colour=RGB, interlaced=False, palette=None, extra=()):
    """rows: lists of samples, interleaved by channel, each below 2**bits. extra: chunks before the pixels."""
    channels = CHANNELS[colour]
    width, height = len(rows[0]) // channels, len(rows)
    raw = bytearray()
    for left, top, dx, dy in PASSES if interlaced else ((0, 0, 1, 1),):
        for y in range(top, height, dy):
            row = [s for x in range(left, width, dx) for s in rows[y][x * channels:(x + 1) * channels]]
            if row:
                raw += b"\0" + packed(row, bits)
    head = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, int(interlaced))
    parts = [chunk(b"IHDR", head), *(chunk(name, data) for name, data in extra)]
    if colour == PALETTE:
        parts.append(chunk(b"PLTE", bytes(v for entry in palette for v in entry)))
    parts += [chunk(b"IDAT", zlib.compress(bytes(raw), 1)), chunk(b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def as_colour(picture, bits, colour):
    """The samples of an 8-bit RGB picture (rows of (r, g, b)) in another colour type. Alpha is opaque."""
    largest = (1 << bits) - 1

    def scaled(value):
        return (value * largest + 127) // 255

    def pixel(p):
        luma = scaled((54 * p[0] + 183 * p[1] + 19 * p[2]) // 256)
        return {GREY: [luma], PALETTE: [luma], GREY_ALPHA: [luma, largest], RGB: [scaled(v) for v in p],
                RGBA: [scaled(v) for v in p] + [largest]}[colour]

    return [[s for p in row for s in pixel(p)] for row in picture]
