# What an eye sees of a baked level, with doors opened and shut by name: Godot 3 without a window.
#
#     godot3-server --path . --script seen.gd LEVEL.slv X Y [open NAME | shut NAME]...
#
# Places are those of the map's own file. level.c says how the library is built.
extends SceneTree

func _init():
	var words = OS.get_cmdline_args()
	words = Array(words).slice(Array(words).find("seen.gd") + 1, words.size() - 1)
	var level = load("res://level.gdns").new()
	if not level.open(words[0]):
		OS.exit_code = 2
		quit()
		return
	var x = float(words[1])
	var y = float(words[2])
	for i in range(3, words.size() - 1, 2):
		if not level.set_door(words[i + 1], words[i] == "open"):
			printerr("seen: there is no door ", words[i + 1])
			OS.exit_code = 2
	var cell = level.locate(x, y)
	print("cell ", cell)
	var row = "row"
	for other in range(level.cell_count()):
		if level.can_see(cell, other):
			row += " " + str(other)
	print(row)
	var cells = Array(level.look(x, y, 0))
	cells.sort()
	var seen = "seen"
	for each in cells:
		seen += " " + str(each)
	print(seen)
	var points = level.visible_polygon(x, y, 0)
	print("points ", points.size())
	for point in points:
		print("%.6f %.6f" % [point.x, point.y])
	quit()
