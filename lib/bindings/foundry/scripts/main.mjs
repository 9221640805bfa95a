/**
 * The module in Foundry: game.modules.get('sightline').api, and a button of the token tools for the game master, who is
 * told in the chat who of the scene's tokens sees whom. Only canvases of a browser and Foundry's own names are here.
 */
import { Level } from './package/sightline.js'
import { bake } from './package/bake.js'
import { Watch } from './watch.mjs'

let watch = null // a promise: of the scene that is on the canvas, from the first question on

function forget() {
  watch?.then((open) => open.close(), () => {})
  watch = null
}

/** The scene's walls; a door's change is made in what is open. */
function current() {
  if (!canvas?.scene) throw new Error('Sightline: no scene is on the canvas')
  const walls = canvas.scene.walls.map((wall) => wall.toObject())
  watch ??= Watch.of(walls, canvas.dimensions.sceneRect, { Level, bake })
  return watch
}

/** Where the middle of a token or of its document is, or a place. */
const placeOf = (thing) => {
  const token = thing.object ?? thing
  return { ...(token.center ? { x: token.center.x, y: token.center.y } : { x: thing.x, y: thing.y }), name: thing.name }
}

const api = {
  sees: async (a, b) => (await current()).sees(placeOf(a), placeOf(b)),
  canWalk: async (a, b) => (await current()).canWalk(placeOf(a), placeOf(b)),
  polygon: async (at, view) => (await current()).polygon(placeOf(at), view),
  watchers: async (token) => {
    const open = await current()
    return canvas.tokens.placeables.filter((other) => other !== token && open.sees(placeOf(other), placeOf(token)))
  },
  pairs: async (tokens = canvas.tokens.placeables) => (await current()).pairs(tokens.map(placeOf)),
}

/** Names are text, whatever is in them. */
const plain = (text) => String(text).replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`)

async function tell() {
  const seen = new Map()
  for (const [a, b] of await api.pairs()) seen.set(a, [...(seen.get(a) ?? []), plain(b.name)])
  const rows = [...seen].map(([a, names]) => `<li><b>${plain(a.name)}</b> sees ${names.join(', ')}</li>`)
  const content = rows.length ? `<ul>${rows.join('')}</ul>` : 'Nobody sees anybody.'
  return ChatMessage.create({ content, whisper: [game.user.id], speaker: { alias: 'Sightline' } })
}

Hooks.once('init', () => (game.modules.get('sightline').api = api))
Hooks.on('canvasReady', forget)
Hooks.on('createWall', forget)
Hooks.on('deleteWall', forget)
Hooks.on('updateWall', async (wall, change) => {
  const open = await watch?.catch(() => null)
  if (open && !open.update(wall.toObject(), change)) forget()
})
Hooks.on('getSceneControlButtons', (controls) => {
  const tools = Array.isArray(controls) && controls.find(({ name }) => name === 'token')?.tools
  if (!game.user.isGM || !tools) return
  tools.push({ name: 'sightline', title: 'Who sees whom', icon: 'fa-solid fa-eye', button: true,
    onClick: () => tell().catch((error) => ui.notifications.error(`Sightline: ${error.message}`)) })
})
