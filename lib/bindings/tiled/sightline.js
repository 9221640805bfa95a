/**
 * Sightline in Tiled: what an object sees, drawn as a layer of the map, and the bake of a map that is saved. Tiled reads
 * this file from its folder of extensions. The program `sightline` does the work: it is looked for on the PATH, or where
 * the map's property `sightline` says.
 */
/* global tiled, MapObject, ObjectGroup, Process, TextFile, File */

const LAYER = 'seen (Sightline)'

/** Runs the program; what it prints. An error has the program's own words. */
function run(map, words) {
  const process = new Process()
  try {
    const program = map.property('sightline') || 'sightline'
    const status = process.exec(program, words, false)
    if (status < 0)
      throw new Error(`The command '${program}' does not start: install it, or give the map a property 'sightline' with its place.`)
    if (status !== 0) throw new Error(process.readStdErr().trim() || `sightline ended with status ${status}`)
    return process.readStdOut()
  } finally {
    process.close()
  }
}

const beside = (map, ending) => map.fileName.replace(/\.[^./\\]*$/, '') + ending

/** The map's words for the program: which layers are solid, as `--layers` takes them. */
const choice = (map) => (map.property('sightline_layers') ? ['--layers', map.property('sightline_layers')] : [])

function named(map) {
  if (!map || !map.isTileMap) throw new Error('open a map first')
  if (!map.fileName) throw new Error('save the map first, so that it has a folder')
  return map
}

/** Tells a failure in words and goes on. */
function attempt(call) {
  try {
    call()
  } catch (error) {
    tiled.alert(String(error.message || error), 'Sightline')
  }
}

/** Bakes the map as it is in the window: a copy beside its file, for its tilesets are found from there. */
function bake(map, to = beside(map, '.slv')) {
  const copy = beside(map, '.sightline.tmx')
  const failure = tiled.mapFormat('tmx').write(map, copy)
  if (failure) throw new Error(failure)
  try {
    run(map, ['bake', copy, '-o', to, '--quiet'].concat(choice(map)))
  } finally {
    File.remove(copy)
  }
}

/** The middle of an object; a tile object stands on its place. Turned objects turn about their place. */
function middleOf(object) {
  const [across, down] = [object.width / 2, object.tile ? -object.height / 2 : object.height / 2]
  const turn = (object.rotation * Math.PI) / 180
  return {
    x: object.x + across * Math.cos(turn) - down * Math.sin(turn),
    y: object.y + across * Math.sin(turn) + down * Math.cos(turn),
  }
}

/** The outlines of what is seen from places of the map, in its pixels. */
function seenFrom(map, places) {
  const slv = beside(map, '.sightline.slv'), table = beside(map, '.sightline.geojson')
  try {
    bake(map, slv)
    const { x, y, scale } = JSON.parse(run(map, ['info', slv, '--json', '--quiet'])).transform
    const at = places.map((place) => ['--at', `${x + place.x / scale},${y - place.y / scale}`])
    run(map, [].concat(['isovist', slv, '-o', table, '--quiet'], ...at))
    const file = new TextFile(table, TextFile.ReadOnly)
    const { features } = JSON.parse(file.readAll())
    file.close()
    return features.map(({ geometry }) =>
      geometry.coordinates[0].slice(0, -1).map(([left, up]) => ({ x: scale * (left - x), y: scale * (y - up) })))
  } finally {
    for (const name of [slv, table]) if (File.exists(name)) File.remove(name)
  }
}

function show(map) {
  const objects = map.selectedObjects
  if (!objects.length) throw new Error('select an object to look from')
  const outlines = seenFrom(map, objects.map(middleOf))
  map.macro('Show what is seen', () => {
    for (let i = map.layerCount - 1; i >= 0; i--) if (map.layerAt(i).name === LAYER) map.removeLayerAt(i)
    const layer = new ObjectGroup(LAYER)
    layer.opacity = 0.4
    layer.color = '#ffd54a'
    for (const outline of outlines) {
      const object = new MapObject()
      object.shape = MapObject.Polygon
      object.polygon = outline
      layer.addObject(object)
    }
    map.addLayer(layer)
  })
}

const actions = [
  ['SightlineSeen', 'Show what the selected objects see', () => show(named(tiled.activeAsset))],
  ['SightlineBake', 'Bake visibility', () => bake(named(tiled.activeAsset))],
]
for (const [id, text, call] of actions) tiled.registerAction(id, () => attempt(call)).text = text
tiled.extendMenu('Map', [{ separator: true }].concat(actions.map(([action]) => ({ action }))))

// Maps with the property `sightline_bake` are baked whenever they are saved.
tiled.assetSaved.connect((asset) => {
  if (asset.isTileMap && asset.property('sightline_bake')) attempt(() => bake(asset))
})
