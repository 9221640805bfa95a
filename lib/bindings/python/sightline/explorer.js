// The page of Explorer: a canvas where the eye follows the pointer, and a door opens and shuts by a click.
import { Level } from 'sightline'

const { slv, eye } = JSON.parse(document.getElementById('level').textContent)
const canvas = document.querySelector('canvas'), said = document.querySelector('output')
const pen = canvas.getContext('2d')
const level = await Level.open(Uint8Array.from(atob(slv), (letter) => letter.charCodeAt(0)))
const { minX, minY, maxX, maxY } = level.bounds
const margin = 8, scale = Math.min((canvas.width - 2 * margin) / (maxX - minX), (canvas.height - 2 * margin) / (maxY - minY))
const across = (x) => margin + (x - minX) * scale, down = (y) => margin + (maxY - y) * scale
let [x, y] = eye

function path(points, close) {
  pen.beginPath()
  for (let i = 0; i < points.length; i += 2) pen.lineTo(across(points[i]), down(points[i + 1]))
  if (close) pen.closePath()
}

function lines(segments, colour, dashes = []) {
  pen.strokeStyle = colour
  pen.setLineDash(dashes)
  for (const segment of segments) {
    path(segment)
    pen.stroke()
  }
}

function area(points) {
  let sum = 0
  for (let i = 0, j = points.length - 2; i < points.length; j = i, i += 2)
    sum += points[j] * points[i + 1] - points[i] * points[j + 1]
  return sum / 2
}

function draw() {
  pen.clearRect(0, 0, canvas.width, canvas.height)
  pen.fillStyle = '#eef2f5'
  for (const { corners, inside } of level.cells)
    if (inside) {
      path(corners, true)
      pen.fill()
    }
  const seen = level.visiblePolygon(x, y)
  pen.fillStyle = '#f2d16b'
  path(seen, true)
  pen.fill()
  pen.lineWidth = 1.5
  lines(level.walls, '#222222')
  pen.lineWidth = 3
  for (const { open, segments } of level.doors) lines(segments, '#b5651d', open ? [4, 3] : [])
  pen.fillStyle = '#c0392b'
  pen.fillRect(across(x) - 3, down(y) - 3, 6, 6)
  said.textContent = `${x.toFixed(2)}, ${y.toFixed(2)}: area ${area(seen).toFixed(2)}, ${level.look(x, y).length} cells`
}

/** The place in the map that an event is at. */
function placeOf(event) {
  const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width
  return [minX + ((event.clientX - box.left) * ratio - margin) / scale, maxY - ((event.clientY - box.top) * ratio - margin) / scale]
}

canvas.addEventListener('pointermove', (event) => {
  const [toX, toY] = placeOf(event)
  if (level.locate(toX, toY) < 0) return
  x = toX
  y = toY
  draw()
})
canvas.addEventListener('click', (event) => {
  const [atX, atY] = placeOf(event)
  const near = level.doors.find(({ segments }) => segments.some(([x0, y0, x1, y1]) =>
    Math.hypot((x0 + x1) / 2 - atX, (y0 + y1) / 2 - atY) < Math.hypot(x1 - x0, y1 - y0)))
  if (near) level.setDoor(near.name, !near.open)
  draw()
})
draw()
