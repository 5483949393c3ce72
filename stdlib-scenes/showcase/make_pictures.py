#!/usr/bin/env python3
"""make_pictures.py: writes the pictures the showcase scenes use, from formulas alone:
leaf.png (with its outline as alpha), globe.png (continents of value noise) and sky.hdr."""
import math
import os
import struct
import zlib

here = os.path.dirname(os.path.abspath(__file__))


def hash3(x, y, z):
    h = (x * 374761393 + y * 668265263 + z * 2147483647) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFFFF) / 0xFFFFFF


def noise(x, y, z):
    """Value noise in [0, 1] with smooth steps."""
    cell = [math.floor(v) for v in (x, y, z)]
    s = [v - c for v, c in zip((x, y, z), cell)]
    s = [t * t * (3 - 2 * t) for t in s]
    total = 0.0
    for corner in range(8):
        weight, at = 1.0, []
        for axis in range(3):
            up = corner >> axis & 1
            weight *= s[axis] if up else 1 - s[axis]
            at.append(cell[axis] + up)
        total += weight * hash3(*at)
    return total


def fractal(x, y, z, octaves):
    total, scale, weight = 0.0, 1.0, 0.5
    for _ in range(octaves):
        total += weight * noise(x * scale, y * scale, z * scale)
        scale, weight = scale * 2.03, weight / 2
    return total / (1 - 0.5 ** octaves)


def mix(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def save_png(name, width, height, channels, pixel):
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            rows.extend(min(255, max(0, int(v + 0.5))) for v in pixel(x, y))
    kind = {3: 2, 4: 6}[channels]

    def chunk(tag, data):
        return (struct.pack('>I', len(data)) + tag + data
                + struct.pack('>I', zlib.crc32(tag + data)))

    header = struct.pack('>IIBBBBB', width, height, 8, kind, 0, 0, 0)
    with open(os.path.join(here, name), 'wb') as out:
        out.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header)
                  + chunk(b'IDAT', zlib.compress(bytes(rows), 9)) + chunk(b'IEND', b''))


def leaf(x, y, size=128):
    u, v = (x + 0.5) / size * 2 - 1, 1 - (y + 0.5) / size  # v: from the tip below to the stalk
    half = 0.86 * math.sin(math.pi * min(1, v / 0.94)) ** 0.7 * (0.55 + 0.45 * v) if v < 0.94 else 0
    half *= 0.93 + 0.07 * math.cos(26 * v)  # a toothed edge
    stalk = v >= 0.9 and abs(u) < 0.025
    inside = abs(u) < half or stalk
    vein = abs(u) < 0.02 or abs((v - 0.55 * abs(u)) * 8 % 1 - 0.5) > 0.46
    shade = 0.85 + 0.3 * fractal(4 * u, 4 * v, 1, 4)
    green = (116, 146, 66) if vein else (58, 100, 38)
    return (*(c * shade for c in green), 255 if inside else 0)


def globe(x, y, width=512, height=256):
    lon, lat = (x + 0.5) / width * 2 * math.pi, (0.5 - (y + 0.5) / height) * math.pi
    p = (math.cos(lat) * math.cos(lon), math.sin(lat), math.cos(lat) * math.sin(lon))
    land = fractal(1.7 * p[0] + 5, 1.7 * p[1] + 5, 1.7 * p[2] + 5, 7)
    cold = abs(lat) / (math.pi / 2) + 0.25 * (fractal(*(6 * c + 9 for c in p), 3) - 0.5)
    if cold > 0.86:
        color = (236, 240, 243)
    elif land > 0.53:
        dry = fractal(*(3 * c + 20 for c in p), 4)
        color = mix((94, 124, 62), (196, 168, 108), min(1, max(0, (dry - 0.4) * 5)))
        color = mix(color, (120, 96, 76), min(1, max(0, (land - 0.62) * 9)))
    else:
        color = mix((24, 60, 112), (72, 140, 176), min(1, max(0, (land - 0.36) * 5)))
    grid = min(x % (width // 24), y % (height // 12)) == 0
    return mix(color, (40, 40, 40), 0.25) if grid else color


def sky(x, y, width=128, height=64):
    """Linear radiance: a blue dome, a warm horizon, haze, a wide sun and dark ground."""
    lon, lat = (x + 0.5) / width * 2 * math.pi, (0.5 - (y + 0.5) / height) * math.pi
    if lat < 0:
        return mix((0.16, 0.14, 0.12), (0.4, 0.34, 0.3), math.exp(lat * 12))
    clouds = max(0, fractal(3 * math.cos(lon), 9 * lat, 3 * math.sin(lon), 5) - 0.5) * 3
    color = mix((1.3, 0.95, 0.7), (0.18, 0.36, 0.85), 1 - math.exp(-4 * lat))
    color = mix(color, (1.5, 1.45, 1.4), min(1, clouds))
    away = (lon - 1.1) ** 2 * math.cos(lat) ** 2 + (lat - 0.62) ** 2
    glow = 60 * math.exp(-away / 0.012) + 0.8 * math.exp(-away / 0.15)
    return tuple(c + glow * s for c, s in zip(color, (1, 0.86, 0.66)))


def save_hdr(name, width, height, pixel):
    with open(os.path.join(here, name), 'wb') as out:
        out.write(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n' % (height, width))
        for y in range(height):
            for x in range(width):
                rgb = pixel(x, y)
                mantissa, exponent = math.frexp(max(rgb))
                scale = mantissa * 256 / max(rgb)
                out.write(bytes([*(int(c * scale) for c in rgb), exponent + 128]))


save_png('leaf.png', 128, 128, 4, leaf)
save_png('globe.png', 512, 256, 3, globe)
save_hdr('sky.hdr', 128, 64, sky)
