"""Small files of other programs, for check_readers.py: what authors do, one or two things a file."""
import base64
import json
import pathlib
import struct
import sys
import zlib

sys.path.append(str(pathlib.Path(__file__).parent.parent / "command"))
import wad  # noqa: E402

ROOM = [(0, 0), (90, 0), (90, 60), (0, 60), (0, 0)]


def scene():
    walls = [{"c": [*a, *b], "move": 20, "sight": 20} for a, b in zip(ROOM, ROOM[1:])]
    walls += [{"c": [30, 0, 30, 40], "move": 20, "sight": 20},
              {"c": [30, 40, 30, 60], "move": 20, "sight": 20, "door": 1, "ds": 0},
              {"c": [60, 13, 77, 31], "move": 20, "sight": 20}]
    return json.dumps({"name": "Cellar", "walls": walls, "width": 100, "height": 80})


def battle_map():
    lines = [ROOM, [(45.5, 0), (45.5, 20.25), (50, 33)]]
    places = [[{"x": x, "y": y} for x, y in line] for line in lines]
    return json.dumps({"format": 0.3, "line_of_sight": places, "image": "",
                       "resolution": {"map_origin": {"x": 0, "y": 0}, "map_size": {"x": 90, "y": 60},
                                      "pixels_per_grid": 100},
                       "portals": [{"position": {"x": 50, "y": 46.5}, "closed": True, "rotation": 0,
                                    "bounds": [{"x": 50, "y": 33}, {"x": 50, "y": 60}]}]})


def ring(columns, rows, wall):
    """Squares with a wall around and a pillar in the middle."""
    return [wall if x in (0, columns - 1) or y in (0, rows - 1) or (x, y) == (columns // 2, rows // 2)
            else 0 for y in range(rows) for x in range(columns)]


def tmx():
    gids = ring(9, 7, 2)
    packed = base64.b64encode(zlib.compress(struct.pack(f"<{len(gids)}I", *gids))).decode()
    floor = ",".join(["1"] * len(gids))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<map version="1.10" orientation="orthogonal" width="9" height="7" tilewidth="16" tileheight="16">
 <tileset firstgid="1" name="plain" tilewidth="16" tileheight="16" tilecount="4" columns="2">
  <image source="plain.png" width="32" height="32"/></tileset>
 <layer id="1" name="floor" width="9" height="7"><data encoding="csv">{floor}</data></layer>
 <layer id="2" name="walls" width="9" height="7">
  <data encoding="base64" compression="zlib">{packed}</data></layer>
</map>
"""


def tmj():
    return json.dumps({
        "type": "map", "orientation": "orthogonal", "width": 9, "height": 7, "tilewidth": 16,
        "tileheight": 16, "tilesets": [], "version": "1.10", "infinite": False,
        "layers": [{"type": "objectgroup", "name": "collisions", "id": 1, "visible": True, "objects": [
            {"id": 1, "name": "", "type": "", "x": 16, "y": 16, "width": 48, "height": 24, "rotation": 0},
            {"id": 2, "name": "", "type": "", "x": 90, "y": 60, "width": 0, "height": 0, "rotation": 0,
             "polygon": [{"x": 0, "y": 0}, {"x": 30, "y": 10}, {"x": -10, "y": 31}]}]}]})


def project():
    layer = {"__identifier": "Walls", "__type": "IntGrid", "__cWid": 9, "__cHei": 7, "__gridSize": 16,
             "__pxTotalOffsetX": 0, "__pxTotalOffsetY": 0, "layerDefUid": 1, "levelId": 1, "iid": "l",
             "visible": True, "intGridCsv": ring(9, 7, 1), "gridTiles": [], "autoLayerTiles": [],
             "entityInstances": []}
    level = {"identifier": "Level_0", "iid": "a", "uid": 1, "worldX": 0, "worldY": 0, "worldDepth": 0,
             "pxWid": 144, "pxHei": 112, "layerInstances": [layer], "fieldInstances": []}
    define = {"identifier": "Walls", "type": "IntGrid", "__type": "IntGrid", "uid": 1, "gridSize": 16,
              "intGridValues": [{"value": 1, "identifier": "wall", "color": "#000000"}]}
    return json.dumps({"jsonVersion": "1.5.3", "defs": {"layers": [define], "entities": [], "enums": []},
                       "worldLayout": "Free", "externalLevels": False, "levels": [level]})


def dxf():
    def entity(kind, layer, *values):
        return [(0, kind), (8, layer), *values]

    pairs = [(0, "SECTION"), (2, "BLOCKS"), (0, "BLOCK"), (8, "0"), (2, "PIER"), (70, 0), (10, 5), (20, 0)]
    pairs += entity("LWPOLYLINE", "0", (90, 4), (70, 1), (10, 5), (20, 0), (10, 9), (20, 0), (10, 9),
                    (20, 4), (10, 5), (20, 4))
    pairs += [(0, "ENDBLK"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for (x0, y0), (x1, y1) in zip(ROOM, ROOM[1:]):
        pairs += entity("LINE", "WALLS", (10, x0), (20, y0), (11, x1), (21, y1))
    pairs += entity("LWPOLYLINE", "WALLS", (90, 3), (70, 0), (10, 30), (20, 0), (10, 30), (20, 20),
                    (42, 0.5), (10, 45), (20, 35))
    pairs += entity("INSERT", "WALLS", (2, "PIER"), (10, 60), (20, 30), (41, 2), (42, 1.5), (50, 25))
    pairs += entity("ARC", "WALLS", (10, 70), (20, 20), (40, 8), (50, 300), (51, 80))
    pairs += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{text}\n" for code, text in pairs)


SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" width="100" height="80">
 <defs><rect id="pier" width="6" height="4"/></defs>
 <g id="walls" fill="none" stroke="black">
  <path d="M0,0h90v60H0z m45,0 l0,20 c0,10 10,10 10,20"/>
  <g transform="translate(20 20) rotate(30)"><rect x="0" y="0" width="12" height="9"/></g>
  <use href="#pier" x="70" y="30"/>
  <polyline points="70,0 70,14 82,14"/>
  <circle cx="20" cy="48" r="6"/>
  <path d="M30 44A9 5 20 0 0 40 52a5,4 0 112 3"/>
  <rect x="50" y="46" width="16" height="9" rx="4"/>
 </g>
</svg>
"""

ROS = "image: floor.pgm\nresolution: 0.05\norigin: [-1.5, 2.0, 0.0]\nnegate: 0\n" \
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n"


def floor():
    pixels = [0 if wall else 254 for wall in ring(9, 7, 1)]
    pixels[12] = 205
    return b"P5\n# ROS\n9 7\n255\n" + bytes(pixels)


LEVELS = wad.make_wad(wad.rooms("MAP01", 4), [("A_START", b""), ("BEHAVIOR", b"ACS")],
                      wad.text_of_map("MAP02", [(0, 0, 0, 64, 0, None), (0, 64, 64, 0, 0, None),
                                                (64, 0, 0, 0, 0, None)], 1, {}))

FILES = {"scene.json": scene(), "map.dd2vtt": battle_map(), "layers.tmx": tmx(), "objects.tmj": tmj(),
         "project.ldtk": project(), "plan.dxf": dxf(), "plan.svg": SVG, "level.wad": LEVELS, "floor.pgm": floor(),
         "floor.yaml": ROS}
