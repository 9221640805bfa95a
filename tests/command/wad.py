"""Doom WADs for tests: maps of rooms or pillars, written and read lump by lump."""
import struct


def lumps_of_map(name, lines, sector_count, reject=None):
    """Lines are (x0, y0, x1, y1, sector at the right, sector at the left or None)."""
    vertices = sorted({point for line in lines for point in (line[:2], line[2:4])})
    number = {point: i for i, point in enumerate(vertices)}
    sides, records = b"", b""
    count = 0
    for line in lines:
        own = [0xffff, 0xffff]
        for i, sector in enumerate(line[4:]):
            if sector is not None:
                sides += struct.pack("<28xH", sector)
                own[i] = count
                count += 1
        records += struct.pack("<7H", number[line[:2]], number[line[2:4]],
                               1 if own[1] == 0xffff else 4, 0, 0, *own)
    lumps = [(name, b""), ("THINGS", struct.pack("<5h", 32, 32, 90, 1, 7)), ("LINEDEFS", records),
             ("SIDEDEFS", sides),
             ("VERTEXES", b"".join(struct.pack("<hh", *vertex) for vertex in vertices)),
             ("SECTORS", sector_count * struct.pack("<hh18xhH", 0, 128, 0, 0))]
    if reject is not None:
        lumps.append(("REJECT", reject))
    return lumps + [("BLOCKMAP", b"any")]


def text_of_map(name, lines, sector_count, specials):
    """The same as text (UDMF), with Hexen's specials: the number of a line -> its fields."""
    text = 'namespace = "zdoom";\nthing { x = 32; y = 32; type = 1; }\n'
    text += sector_count * "sector { heightceiling = 128; }\n"
    side = 0
    for i, line in enumerate(lines):
        text += "".join("vertex { x = %d; y = %d; }\n" % point for point in (line[:2], line[2:4]))
        fields = "v1 = %d; v2 = %d;" % (2 * i, 2 * i + 1)
        for key, sector in zip(("sidefront", "sideback"), line[4:]):
            if sector is not None:
                text += "sidedef { sector = %d; }\n" % sector
                fields += " %s = %d;" % (key, side)
                side += 1
        text += "linedef { %s %s }\n" % (fields, specials.get(i, ""))
    return [(name, b""), ("TEXTMAP", text.encode()), ("ENDMAP", b"")]


def blocked_passage(name, special):
    """Two rooms, a passage between them, and a block that fills the passage, with a special."""
    lines = [(0, 0, 0, 256, 0, None), (0, 256, 256, 256, 0, None), (256, 256, 256, 192, 0, None),
             (256, 192, 256, 64, 0, 1), (256, 64, 256, 0, 0, None), (256, 0, 0, 0, 0, None),
             (256, 192, 320, 192, 1, None), (320, 192, 320, 64, 1, 2), (320, 64, 256, 64, 1, None),
             (320, 256, 576, 256, 2, None), (576, 256, 576, 0, 2, None), (576, 0, 320, 0, 2, None),
             (320, 0, 320, 64, 2, None), (320, 192, 320, 256, 2, None),
             (280, 64, 296, 64, 1, None), (296, 64, 296, 192, 1, None),
             (296, 192, 280, 192, 1, None), (280, 192, 280, 64, 1, None)]
    return text_of_map(name, lines, 3, {14: special})


def rooms(name, count, skew=0, reject=None):
    """Rooms in a row, doorways between them that go up and down, each room and doorway a sector."""
    lines = []
    for i in range(count):
        x, room = 80 * i, 2 * i
        west, east = (2 if i % 2 else 44), (44 if i % 2 else 2)
        lines.append((x, 64 + skew, x + 64, 64, room, None))
        lines.append((x + 64, 0, x, 0, room, None))
        if i == 0:
            lines.append((x, 0, x, 64 + skew, room, None))
        else:
            lines += [(x, 0, x, west, room, None), (x, west, x, west + 16, room, room - 1),
                      (x, west + 16, x, 64 + skew, room, None)]
        if i + 1 == count:
            lines.append((x + 64, 64, x + 64, 0, room, None))
        else:
            lines += [(x + 64, 64, x + 64, east + 16, room, None),
                      (x + 64, east + 16, x + 64, east, room, room + 1),
                      (x + 64, east, x + 64, 0, room, None),
                      (x + 64, east + 16, x + 80, east + 16, room + 1, None),
                      (x + 80, east, x + 64, east, room + 1, None)]
    return lumps_of_map(name, lines, 2 * count - 1, reject)


def pillars(name, count):
    """A hall of skew pillars: a long bake."""
    side = 64 * count
    lines = [(0, 0, 0, side, 0, None), (0, side, side, side, 0, None),
             (side, side, side, 0, 0, None), (side, 0, 0, 0, 0, None)]
    for i in range(count):
        for j in range(count):
            x, y = 64 * i + 16 + (7 * j) % 5, 64 * j + 16 + (5 * i) % 7
            corners = [(x, y), (x + 20, y + 3), (x + 17, y + 23), (x - 3, y + 20)]
            for a, b in zip(corners, corners[1:] + corners[:1]):
                lines.append((*a, *b, 0, None))
    return lumps_of_map(name, lines, 1)


def make_wad(*groups):
    body, directory, count = b"", b"", 0
    for name, lump in (pair for group in groups for pair in group):
        directory += struct.pack("<II8s", 12 + len(body), len(lump), name.encode())
        body += lump
        count += 1
    return struct.pack("<4sII", b"PWAD", count, 12 + len(body)) + body + directory


def lumps_of_wad(content):
    count, at = struct.unpack_from("<II", content, 4)
    lumps = []
    for i in range(count):
        offset, size, name = struct.unpack_from("<II8s", content, at + 16 * i)
        lumps.append((name.rstrip(b"\0").decode(), content[offset:offset + size]))
    return lumps
