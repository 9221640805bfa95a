function love.conf(t)
    t.window.title = "What the mouse sees"
    t.window.width, t.window.height = 900, 600
    t.window.resizable = true
    t.modules.audio, t.modules.sound, t.modules.joystick, t.modules.physics = false, false, false, false
end
