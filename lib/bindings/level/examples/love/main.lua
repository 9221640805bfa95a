-- Fog of war in LÖVE: what the mouse sees, in the coordinates of the map's own file.
--
--     love lib/bindings/level/examples/love LEVEL.slv               move the mouse; keys 1 to 9: doors
--     love lib/bindings/level/examples/love LEVEL.slv X Y PICTURE   one picture of what (X, Y) sees
--
-- SIGHTLINE_LEVEL names the shared library, if it is not where the system looks for libraries.
package.path = love.filesystem.getSource() .. "/../../?.lua;" .. package.path
local sightline = require("sightline")

local level, doors, picture
local eye = {}
local place = {} -- of the map in the window: its 0, 0, and pixels a unit of x and of y

function love.load(arguments)
    level = assert(sightline.open(assert(arguments[1], "LEVEL.slv is missing")))
    level:use_file_coordinates() -- a file before 2.0 does not have them: it keeps those of the map
    eye.x, eye.y, picture = tonumber(arguments[2]), tonumber(arguments[3]), arguments[4]
    doors = level:doors()
end

local function arrange()
    local min_x, min_y, max_x, max_y = level:bounds()
    local width, height = love.graphics.getDimensions()
    place.scale = math.min(width / (max_x - min_x), height / (max_y - min_y))
    place.scale_y = level:y_is_down() and place.scale or -place.scale -- y is up in map text
    place.x = (width - place.scale * (max_x + min_x)) / 2
    place.y = (height - place.scale_y * (max_y + min_y)) / 2
end

function love.mousemoved(x, y)
    if picture then return end
    arrange()
    eye.x, eye.y = (x - place.x) / place.scale, (y - place.y) / place.scale_y
end

function love.keypressed(key)
    local door = doors[tonumber(key)]
    if door then level:set_door(door.name, not door.open) end
    doors = level:doors()
end

function love.draw()
    arrange()
    love.graphics.clear(0.25, 0.25, 0.28)
    love.graphics.push()
    love.graphics.translate(place.x, place.y)
    love.graphics.scale(place.scale, place.scale_y)
    love.graphics.setLineWidth(1.5 / place.scale)
    for cell = 0, level:cell_count() - 1 do
        if level:is_solid(cell) then love.graphics.setColor(0.1, 0.1, 0.1) else love.graphics.setColor(0.45, 0.45, 0.5) end
        love.graphics.polygon("fill", level:cell_corners(cell))
    end
    local points = eye.x and level:visible_polygon(eye.x, eye.y) or {}
    love.graphics.setColor(1, 0.93, 0.6)
    -- Triangles from the eye: the polygon is not convex.
    for i = 1, #points, 2 do
        local k = i + 2 > #points and 1 or i + 2
        love.graphics.polygon("fill", eye.x, eye.y, points[i], points[i + 1], points[k], points[k + 1])
    end
    for _, door in ipairs(doors) do
        if door.open then love.graphics.setColor(0, 0.6, 0.3) else love.graphics.setColor(0.84, 0.37, 0) end
        for i = 1, #door.segments, 4 do love.graphics.line(unpack(door.segments, i, i + 3)) end
    end
    if eye.x then
        love.graphics.setColor(0, 0, 0)
        love.graphics.circle("fill", eye.x, eye.y, 4 / place.scale)
    end
    love.graphics.pop()
    if picture then
        love.graphics.captureScreenshot(function(shot)
            local file = assert(io.open(picture, "wb"))
            file:write(shot:encode("png"):getString())
            file:close()
            love.event.quit()
        end)
    end
end
