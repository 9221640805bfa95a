"""Fog of war in pygame: what the mouse sees, in the coordinates of the map's own file.

    python3 main.py LEVEL.slv               move the mouse; keys 1 to 9: doors
    python3 main.py LEVEL.slv X Y PICTURE   one picture of what (X, Y) sees

A copy of this folder needs sightline_level.py, too, which stands two folders up here.
"""
import pathlib
import sys

import pygame

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from sightline_level import Level  # noqa: E402

SIZE = 900, 600


class Game:
    def __init__(self, file):
        self.level = Level(file)
        self.level.use_file_coordinates()  # a file before 2.0 does not have them: it keeps those of the map
        x0, y0, x1, y1 = self.level.bounds()
        scale = min(SIZE[0] / (x1 - x0), SIZE[1] / (y1 - y0))
        self.scale = scale, scale if self.level.y_is_down() else -scale  # y is up in map text
        self.origin = (SIZE[0] - self.scale[0] * (x0 + x1)) / 2, (SIZE[1] - self.scale[1] * (y0 + y1)) / 2
        self.cells = [(self.level.is_solid(cell), self.in_window(self.level.cell_corners(cell)))
                      for cell in range(self.level.cell_count())]

    def in_window(self, points):
        return [(self.origin[0] + self.scale[0] * x, self.origin[1] + self.scale[1] * y) for x, y in points]

    def in_map(self, place):
        return [(at - origin) / scale for at, origin, scale in zip(place, self.origin, self.scale)]

    def turn_door(self, number):
        doors = self.level.doors()
        if number < len(doors):
            name, is_open, _ = doors[number]
            self.level.set_door(name, not is_open)

    def draw(self, screen, eye):
        screen.fill((64, 64, 71))
        for solid, corners in self.cells:
            pygame.draw.polygon(screen, (26, 26, 26) if solid else (115, 115, 128), corners)
        seen = self.level.visible_polygon(*eye)
        if len(seen) > 2:
            pygame.draw.polygon(screen, (255, 237, 153), self.in_window(seen))
        for _, is_open, segments in self.level.doors():
            for x0, y0, x1, y1 in segments:
                pygame.draw.line(screen, (0, 153, 77) if is_open else (214, 94, 0), *self.in_window([(x0, y0), (x1, y1)]), 3)
        pygame.draw.circle(screen, (0, 0, 0), self.in_window([eye])[0], 4)


def play(game):
    pygame.init()
    screen, clock = pygame.display.set_mode(SIZE), pygame.time.Clock()
    pygame.display.set_caption("What the mouse sees")
    while True:
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                return
            if event.type == pygame.KEYDOWN and pygame.K_1 <= event.key <= pygame.K_9:
                game.turn_door(event.key - pygame.K_1)
        game.draw(screen, game.in_map(pygame.mouse.get_pos()))
        pygame.display.flip()
        clock.tick(60)


def main(file, *picture):
    game = Game(file)
    if not picture:
        return play(game)
    x, y, name = picture
    screen = pygame.Surface(SIZE)
    game.draw(screen, (float(x), float(y)))
    pygame.image.save(screen, name)


if __name__ == "__main__":
    main(*sys.argv[1:])
