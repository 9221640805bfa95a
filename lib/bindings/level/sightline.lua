-- Baked levels for LuaJIT and LÖVE: the shared library sightline_level, as a module.
--
--     local sightline = require("sightline")
--     local level = assert(sightline.open("level.slv"))
--     local points = level:visible_polygon(x, y)            -- {x1, y1, x2, y2, ...}
--
-- Beside it stands sightline_level.h, which says what each call answers. Cells, doors and boxes are
-- numbered from 0. SIGHTLINE_LEVEL names the shared library, if it is not where the system looks.
local ffi = require("ffi")

-- The declarations are read from the header: without comments, directives and C++.
local folder = debug.getinfo(1, "S").source:match("^@(.*[/\\])") or ""
local function read(name)
    if love and love.filesystem.getInfo(name) then return love.filesystem.read(name) end
    local file = assert(io.open(folder .. name, "rb"))
    local text = file:read("*a")
    file:close()
    return text
end
local declarations = read("sightline_level.h")
    :gsub("//[^\n]*", ""):gsub("#ifdef __cplusplus.-#endif", ""):gsub("#[^\n]*", "")
    :gsub("__declspec%b()", ""):gsub("SL_LEVEL_API", "")
ffi.cdef(declarations)
local c = ffi.load(os.getenv("SIGHTLINE_LEVEL") or "sightline_level")

local count = ffi.new("int32_t[1]")
-- The first `length` numbers of an answer, as a list.
local function list(answer, length)
    local out = {}
    for i = 1, length do out[i] = answer[i - 1] end
    return out
end

local level = {}
level.__index = level

local function wrap(handle)
    if handle == nil then return nil, ffi.string(c.sl_level_error()) end
    return setmetatable({handle = ffi.gc(handle, c.sl_level_close)}, level)
end

local sightline = {}
-- A level from a file; nil and why, with the file's name, if it is none.
function sightline.open(name)
    local opened, why = wrap(c.sl_level_open_file(name))
    return opened, why and name .. ": " .. why
end
-- The same from a string of bytes, such as love.filesystem.read gives.
function sightline.open_bytes(bytes) return wrap(c.sl_level_open(bytes, #bytes)) end

-- Chooses the coordinates of all places, lengths and headings: those of the file that was baked, such
-- as pixels of a Tiled map with y down. False if the baked file does not have them.
function level:use_file_coordinates() return c.sl_level_use_file_coordinates(self.handle) == 1 end

-- Or any others: the place in the map that is 0, 0 there, and units there in a unit of the map.
function level:use_coordinates(origin_x, origin_y, scale, y_down)
    c.sl_level_use_coordinates(self.handle, origin_x, origin_y, scale, y_down and 1 or 0)
end

-- Whether y is down in the coordinates that are chosen, as in the window.
function level:y_is_down() return c.sl_level_y_is_down(self.handle) == 1 end

function level:cell_count() return c.sl_level_cell_count(self.handle) end

function level:bounds()
    local b = ffi.new("double[4]")
    c.sl_level_bounds(self.handle, b)
    return b[0], b[1], b[2], b[3]
end

function level:cell_corners(cell)
    local answer = c.sl_level_cell_corners(self.handle, cell, count)
    return list(answer, 2 * count[0])
end

function level:is_solid(cell) return c.sl_level_is_solid(self.handle, cell) == 1 end

-- x, y and heading of a start; nil if it does not exist.
function level:start(number)
    local s = ffi.new("double[3]")
    if c.sl_level_start(self.handle, number or 0, s) == 0 then return nil end
    return s[0], s[1], s[2]
end

-- Opens or shuts all doors of a name, breaks a wall or builds one; false if there is none, and for a
-- wall that is broken or built already.
function level:set_door(name, open)
    if type(open) ~= "boolean" then error("set_door needs true for open or false for shut", 2) end
    local door = c.sl_level_find_door(self.handle, name, 0)
    return c.sl_level_set_door(self.handle, door, open and 1 or 0) == 1
end

-- Makes can_see exact for the doors as they stand, through some more portals. How many rows are left.
function level:settle(portals) return c.sl_level_settle(self.handle, portals) end

-- The doors of the level: a list of {name =, open =, segments = {x0, y0, x1, y1, ...}}.
function level:doors()
    local out = {}
    for door = 0, c.sl_level_door_count(self.handle) - 1 do
        local segments = c.sl_level_door_segments(self.handle, door, count)
        out[door + 1] = {
            name = ffi.string(c.sl_level_door_name(self.handle, door)),
            open = c.sl_level_door_is_open(self.handle, door) == 1,
            segments = list(segments, 4 * count[0]),
        }
    end
    return out
end

-- The cell of a point; nil for none.
function level:locate(x, y)
    local cell = c.sl_level_locate(self.handle, x, y)
    return cell >= 0 and cell or nil
end

-- Whether something of one cell is seen from somewhere in another. For two points there is sees().
function level:can_see(from, to, more)
    if more then error("can_see takes two cells; sees takes two points: x0, y0, x1, y1", 2) end
    return c.sl_level_can_see(self.handle, from or -1, to or -1) == 1
end

function level:sees(x0, y0, x1, y1) return c.sl_level_sees(self.handle, x0, y0, x1, y1) == 1 end

-- Box `own` does not stop it: that of who walks. It may be left out.
function level:can_walk(x0, y0, x1, y1, own)
    return c.sl_level_can_walk(self.handle, x0, y0, x1, y1, own or -1) == 1
end

-- Where a disc comes to on its way to a point, sliding along what stops it: x, y, and whether it is there.
function level:walk(x0, y0, x1, y1, radius, own)
    local at = ffi.new("double[2]")
    local comes = c.sl_level_walk(self.handle, x0, y0, x1, y1, radius or 0, own or -1, at)
    return at[0], at[1], comes == 1
end

-- Of what an eye sees: all round, or from `heading` with a field of view `fov`, in degrees; within
-- `range`. All but x and y may be left out.
function level:look(x, y, heading, fov, range)
    local cells = c.sl_level_look(self.handle, x, y, heading or 0, fov or 360, range or 0, count)
    return list(cells, count[0])
end

function level:visible_polygon(x, y, heading, fov, range)
    local points = c.sl_level_visible_polygon(self.handle, x, y, heading or 0, fov or 360,
                                              range or 0, count)
    return list(points, 2 * count[0])
end

function level:set_box_count(boxes) return c.sl_level_set_box_count(self.handle, boxes) == 1 end

function level:move_box(box, min_x, min_y, max_x, max_y, blocks)
    c.sl_level_move_box(self.handle, box, min_x, min_y, max_x, max_y, blocks and 1 or 0)
end

-- A list with true for each box that the eye sees: box i is at i + 1.
function level:boxes_seen(x, y, heading, fov, range)
    local seen = c.sl_level_boxes_seen(self.handle, x, y, heading or 0, fov or 360, range or 0, count)
    local out = list(seen, count[0])
    for i = 1, #out do out[i] = out[i] == 1 end
    return out
end

return sightline
