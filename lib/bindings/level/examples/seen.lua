-- What an eye sees of a baked level, with doors opened and shut by name: LuaJIT, or LÖVE's Lua.
--
--     luajit seen.lua LEVEL.slv X Y [open NAME | shut NAME]...
--
-- SIGHTLINE_LEVEL names the shared library, if it is not where the system looks for libraries.
local sightline = require("sightline")

local x, y = tonumber(arg[2]), tonumber(arg[3])
local level, why = sightline.open(arg[1])
if not level then
    io.stderr:write("seen: " .. why .. "\n")
    os.exit(2)
end
for i = 4, #arg, 2 do
    if not level:set_door(arg[i + 1], arg[i] == "open") then
        io.stderr:write("seen: there is no door " .. arg[i + 1] .. "\n")
        os.exit(2)
    end
end

local cell = level:locate(x, y)
print("cell " .. tostring(cell))
local row = {}
for other = 0, level:cell_count() - 1 do
    if level:can_see(cell, other) then row[#row + 1] = other end
end
print("row " .. table.concat(row, " "))
local cells = level:look(x, y)
table.sort(cells)
print("seen " .. table.concat(cells, " "))
local points = level:visible_polygon(x, y)
print("points " .. #points / 2)
for i = 1, #points, 2 do print(string.format("%.17g %.17g", points[i], points[i + 1])) end
