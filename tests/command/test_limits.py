"""Files that ask for more than a limit are refused before the work begins: with 200 MB of memory.

    test_limits.py SIGHTLINE

The system itself refuses more memory (RLIMIT_AS). So no clock decides.
"""
import base64
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile
import zlib

MEMORY = 200 << 20
SECONDS = 10  # of the processor: a file that is unpacked or drawn takes longer


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


def packed(kind, count):
    """Zeros, packed by a codec that Tiled has: one packed mebibyte again and again. The sum at the
    end of a gzip file is wrong, but nobody should come so far."""
    pack = zlib.compressobj(9, zlib.DEFLATED, 31 if kind == "gzip" else 15)
    head = pack.compress(b"") + pack.flush(zlib.Z_FULL_FLUSH)
    mebibyte = pack.compress(bytes(1 << 20)) + pack.flush(zlib.Z_FULL_FLUSH)
    rest = zlib.compressobj(9, zlib.DEFLATED, -15)
    tail = rest.compress(bytes(count % (1 << 20))) + rest.flush()
    tail += struct.pack(">I", count % 65521 << 16 | 1)
    return base64.b64encode(head + mebibyte * (count >> 20) + tail).decode()


def tmx(columns, rows, encoding, data, layers=1):
    layer = (f'<layer id="1" name="ground" width="{columns}" height="{rows}"><data {encoding}>'
             f'{data}</data></layer>')
    return (f'<map orientation="orthogonal" width="{columns}" height="{rows}" tilewidth="8" '
            f'tileheight="8">{layer * layers}</map>').encode()


def dxf(blocks, entities):
    def pairs(items):
        return "".join(f"{code}\n{value}\n" for code, value in items)
    text = "0\nSECTION\n2\nBLOCKS\n"
    for name, content in blocks:
        text += pairs([(0, "BLOCK"), (2, name), (10, 0), (20, 0)]) + pairs(content) + "0\nENDBLK\n"
    return (text + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + pairs(entities) +
            "0\nENDSEC\n0\nEOF\n").encode()


def array(name, columns, rows):
    return [(0, "INSERT"), (2, name), (10, 0), (20, 0), (70, columns), (71, rows), (44, 3), (45, 3)]


LINE = [(0, "LINE"), (8, "0"), (10, 0), (20, 0), (11, 1), (21, 1)]


def nested_arrays():
    blocks = [("B0", LINE)] + [(f"B{i}", array(f"B{i - 1}", 200, 200)) for i in range(1, 9)]
    return dxf(blocks, array("B8", 2, 2))


def deep_blocks(count):
    blocks = [("B0", LINE)] + [(f"B{i}", array(f"B{i - 1}", 1, 1)) for i in range(1, count)]
    return dxf(blocks, array(f"B{count - 1}", 1, 1))


def circles():
    return dxf([("C", [(0, "CIRCLE"), (8, "0"), (10, 0), (20, 0), (40, 1)])], array("C", 2000, 2000))


def curves(kind):
    """A block of curves, 1000 x 1000 times."""
    ellipse = [(0, "ELLIPSE"), (8, "0"), (10, 0), (20, 0), (11, 1), (21, 0), (40, .5)]
    bulges = [(0, "LWPOLYLINE"), (8, "0"), (70, 1)]
    spline = [(0, "SPLINE"), (8, "0"), (71, 3)]
    spline += [(40, min(max(i - 3, 0), 37)) for i in range(44)]
    for i in range(40):
        bulges += [(10, i), (20, 0), (42, 1)]
        spline += [(10, i), (20, i % 7)]
    content = {"ellipse": ellipse, "bulges": bulges, "spline": spline}[kind]
    return dxf([("C", content)], array("C", 1000, 1000))


def shaped_tiles(shapes, side=4000):
    """A layer of tiles that all have the same shapes to collide with, the last one left out."""
    tiles = struct.pack("<I", 1) * (side * side - 1) + bytes(4)
    data = base64.b64encode(zlib.compress(tiles)).decode()
    return (f'<map orientation="orthogonal" width="{side}" height="{side}" tilewidth="8" '
            'tileheight="8"><tileset firstgid="1" name="t" tilewidth="8" tileheight="8" '
            f'tilecount="1" columns="1"><tile id="0"><objectgroup>{shapes}</objectgroup></tile>'
            f'</tileset><layer id="1" name="g" width="{side}" height="{side}">'
            f'<data encoding="base64" compression="zlib">{data}</data></layer></map>').encode()


def svg(body):
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{body}</svg>'.encode()


def nested_uses():
    body = '<g id="g0"><line x2="1" y2="1"/></g>'
    for i in range(1, 12):
        body += f'<g id="g{i}">' + f'<use href="#g{i - 1}"/>' * 10 + "</g>"
    return svg(f'<defs>{body}</defs><use href="#g11"/>')


def used_polylines():
    points = " ".join(f"{i},{i % 7}" for i in range(100000))
    return svg(f'<defs><polyline id="p" points="{points}"/></defs>' + '<use href="#p"/>' * 200)


def png(side):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    head = struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0)
    pack = zlib.compressobj(9)
    row = bytes(1 + (side + 7) // 8)
    data = b"".join(pack.compress(row) for _ in range(side)) + pack.flush()
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def ldtk(side):
    return ('{"__header__": {"app": "LDtk"}, "worlds": [], "defs": {"layers": []}, "levels": [' +
            ",".join('{"identifier": "L%d", "worldX": %d, "worldY": 0, "pxWid": 8, "pxHei": 8, '
                     '"layerInstances": [{"__identifier": "W", "__type": "IntGrid", "__cWid": 1, '
                     '"__cHei": 1, "__gridSize": 8, "intGridCsv": [1]}]}' % (i, i * side)
                     for i in range(2)) + "]}").encode()


def spread_chunks():
    chunk = '<chunk x="{}" y="{}" width="1" height="1">1</chunk>'
    data = chunk.format(0, 0) + chunk.format(100000, 100000)
    return ('<map orientation="orthogonal" width="1" height="1" tilewidth="8" tileheight="8" '
            'infinite="1"><layer id="1" name="solid" width="1" height="1"><data encoding="csv">' +
            data + '</data></layer></map>').encode()


def deep_groups(count):
    return svg("<g>" * count + '<path d="M0 0H50V50H0z" stroke="black" fill="none"/>' + "</g>" * count)


def cases():
    big = 22000
    for kind in "zlib", "gzip":
        data = packed(kind, 4 * big * big)
        yield f"{kind}.tmx", tmx(big, big, f'encoding="base64" compression="{kind}"', data), \
            \
            "layer 'ground', 22000 x 22000: 484000000 squares, more than the limit of " \
            "134217728; --max-squares raises it", []
    # Each layer is within the limit, all of them are not.
    side = 6000
    data = packed("zlib", 4 * side * side)
    yield "layers.tmx", tmx(side, side, 'encoding="base64" compression="zlib"', data, 9), \
        "--max-squares raises it", ["--max-squares", "30000000"]
    yield "spread.tmx", spread_chunks(), "--max-squares raises it", []
    yield "world.ldtk", ldtk(8 * 100000), "", ["--map", "all", "--max-squares", "1000"]
    yield "arrays.dxf", nested_arrays(), "entities, more than the limit of 16777216; --max-entities", []
    yield "itself.dxf", dxf([("A", LINE + array("A", 100, 100))], array("A", 9, 9)), \
        "block 'A' is inserted in itself", []
    yield "deep.dxf", deep_blocks(50000), "more than the limit of 512; --max-depth raises it", []
    yield "circles.dxf", circles(), "128000000 walls, more than the limit of 16777216; --max-walls", []
    yield "ellipses.dxf", curves("ellipse"), "the drawing's blocks give: 32000000 walls", []
    yield "bulges.dxf", curves("bulges"), "the drawing's blocks give: ", []
    yield "splines.dxf", curves("spline"), "the drawing's blocks give: 37000000 walls", []
    box = '<object id="1" x="0" y="0" width="4" height="4"/>'
    none = '<object id="1" x="0" y="0" width="0" height="0"/>'
    full = '<object id="1" x="0" y="0" width="8" height="8"/>'
    yield "boxes.tmx", shaped_tiles(box), \
        "the tiles' shapes give: 63999996 walls, more than the limit of 16777216; --max-walls", []
    for name, shape in ("empty", none), ("full", full), ("points", '<object id="1"><point/></object>'):
        yield f"{name}.tmx", shaped_tiles(shape * 3, 2500), \
            "the tiles' shapes, as often as they are drawn: ", ["--max-entities", "1000000"]
    yield "uses.svg", nested_uses(), "more than the limit of 16777216; --max-entities raises it", []
    yield "lines.svg", used_polylines(), "more than the limit of 16777216; --max-walls raises it", []
    yield "deep.svg", deep_groups(600), "513 levels, more than the limit of 512; --max-depth raises it", []
    yield "itself.svg", svg('<g id="a"><line x2="1"/><use href="#a"/></g>'), \
        "use: element 'a' holds a use of itself", []
    yield "black.png", png(17000), "a picture of 17000 x 17000: 289000000 pixels, more than the limit of 268435456; --max-pixels", []
    yield "header.pgm", b"P5 16000 16000 255\n", "16000 x 16000 pixels need at least 32000000 bytes; the file has 1", []
    yield "header.pbm", b"P1 16000 16000\n", "16000 x 16000 pixels need at least 32000000 bytes; the file has 1", []


def run(program, arguments, **more):
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=300, **more)


def main():
    program = sys.argv[1]
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, data, message, options in cases():
            (folder / name).write_bytes(data)
            done = run(program, ["convert", str(folder / name), "-o", str(folder / "out.map"), *options],
                       preexec_fn=limited)
            if done.returncode != 2 or message not in done.stderr:
                faults.append(f"{name}: status {done.returncode}: {done.stderr.strip()[:300]}")
            if (folder / "out.map").exists():
                faults.append(f"{name}: wrote a file")
        # A limit that is raised lets the file pass, one that is lowered refuses it.
        path = folder / "arrays.dxf"
        path.write_bytes(dxf([("B", LINE)], array("B", 30, 30)))
        for options, status in (([], 0), (["--max-entities", "900"], 2), (["--max-walls", "899"], 2),
                                (["--max-walls", "900", "--max-entities", "1801"], 0)):
            done = run(program, ["convert", str(path), *options])
            if done.returncode != status:
                faults.append(f"{options}: status {done.returncode}: {done.stderr.strip()[:300]}")
        # Tiles that their shapes cover are squares, and no walls.
        tiles = folder / "tiles.tmx"
        tiles.write_bytes(shaped_tiles('<object id="1" x="0" y="0" width="8" height="8"/>', 300))
        done = run(program, ["convert", str(tiles), "--max-walls", "100", "--max-entities", "100"])
        if done.returncode:
            faults.append(f"tiles.tmx: status {done.returncode}: {done.stderr.strip()[:300]}")
        # All commands that read maps take the limits.
        for command in (["info"], ["check"], ["isovist", "--grid", "1"]):
            done = run(program, [*command, str(path), "--max-walls", "10"])
            if done.returncode != 2 or "--max-walls raises it" not in done.stderr:
                faults.append(f"{command}: status {done.returncode}: {done.stderr.strip()[:300]}")
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
