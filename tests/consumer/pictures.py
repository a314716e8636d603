"""pictures.py A.PNG B.PNG TOLERANCE FRACTION: fails if more than this fraction of pixels differs by more than TOLERANCE levels.

Prints both for the two pictures. Reads 8-bit PNG files without interlacing, as Viete writes them.
"""
import struct
import sys
import zlib


def paeth(left, up, corner):
    guess = left + up - corner
    return min((left, up, corner), key=lambda value: abs(guess - value))


def pixels(path):
    """Returns the width and the rows of a picture, as bytes with 3 or 4 channels per pixel."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and colour in (2, 6) and not interlaced, path
        packed += body if kind == b"IDAT" else b""
        at += length + 12
    channels = 3 if colour == 2 else 4
    raw, size = zlib.decompress(packed), width * channels
    rows, above = [], bytes(size)
    for y in range(height):
        method, row = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for i in range(size):
            left, corner = (row[i - channels], above[i - channels]) if i >= channels else (0, 0)
            row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[method]) % 256
        rows.append(row)
        above = row
    return channels, width, rows


def main(first, second, tolerance, fraction):
    channels, width, rows = pixels(first)
    others, other_width, other_rows = pixels(second)
    if (channels, width, len(rows)) != (others, other_width, len(other_rows)):
        sys.exit("the pictures have different sizes")
    differences = [max(abs(a - b) for a, b in zip(row[x:x + channels], other[x:x + channels]))
                   for row, other in zip(rows, other_rows) for x in range(0, len(row), channels)]
    differing = sum(difference > tolerance for difference in differences) / len(differences)
    print(f"the largest difference is {max(differences)} levels; {100 * differing:.3g} % of pixels differ by more than {tolerance}")
    sys.exit(differing > fraction)


main(sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]))
