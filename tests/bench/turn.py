"""Turns a map by an angle: turn.py DEGREES < IN.map > OUT.map

Points of walls, doors, seams, mirrors, one-way glass and starts are turned about the origin, in doubles.
"""
import math
import sys

angle = math.radians(float(sys.argv[1]))
cosine, sine = math.cos(angle), math.sin(angle)
for line in sys.stdin:
    words = line.split("#")[0].split()
    first = 2 if words and words[0] == "door" else 1
    last = 3 if words and words[0] == "start" else len(words)
    if words and words[0] in ("wall", "walls", "door", "seam", "mirror", "oneway", "start"):
        for i in range(first, last - 1, 2):
            try:
                x, y = float(words[i]), float(words[i + 1])
            except ValueError:
                break
            words[i:i + 2] = [repr(cosine * x - sine * y), repr(sine * x + cosine * y)]
        line = " ".join(words) + "\n"
    sys.stdout.write(line)
