# Fog of war in Godot 3: what an eye sees of a baked level, as a picture.
#
#     godot3-runner --path . fog.tscn LEVEL.slv X Y PICTURE.png
#
# Places are those of the map's own file. Map text has y up: it is then upside down. In a game: move the eye, and update().
extends Node2D

var level = load("res://level.gdns").new()
var eye

func _ready():
	var words = Array(OS.get_cmdline_args())
	words = words.slice(words.size() - 4, words.size() - 1)
	if not level.open(words[0]):
		OS.exit_code = 2
		get_tree().quit()
		return
	eye = Vector2(float(words[1]), float(words[2]))
	var bounds = level.bounds()
	var room = get_viewport_rect().size
	var size = bounds[1] - bounds[0]
	var factor = min(room.x / size.x, room.y / size.y)
	scale = Vector2(factor, factor)
	position = (room - factor * (bounds[0] + bounds[1])) / 2
	yield(VisualServer, "frame_post_draw")
	yield(VisualServer, "frame_post_draw")
	var picture = get_viewport().get_texture().get_data()
	picture.flip_y()
	OS.exit_code = 0 if picture.save_png(words[3]) == OK else 1
	get_tree().quit()

func _draw():
	if not eye:
		return
	for cell in range(level.cell_count()):
		draw_colored_polygon(level.cell_corners(cell), Color(0.1, 0.1, 0.1) if level.is_solid(cell) else Color(0.45, 0.45, 0.5))
	draw_colored_polygon(level.visible_polygon(eye.x, eye.y, 0), Color(1, 0.93, 0.6))
	draw_circle(eye, 4 / scale.x, Color(0, 0, 0))
