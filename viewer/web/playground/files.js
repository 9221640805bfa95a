/** Opening, dropping and saving files. */
import { t } from '../language/language.js';
import { readMapFile } from '../formats/read.js';
import { Camera } from '../parts/camera.js';
import { drawPlan } from '../parts/plan.js';
import { SvgSurface } from '../parts/svg-surface.js';

/** Larger files would fill the page's memory many times over. */
const MOST_BYTES = 256 << 20;

/** @param {Blob} blob @param {string} name */
export function save(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/**
 * @param {File} file @param {(bytes: Uint8Array) => Promise<any>} describe
 * @returns {Promise<import('../formats/read.js').Reading>}
 */
export async function readFile(file, describe) {
    if (file.size > MOST_BYTES) throw new Error(t`${file.name} has more than 256 MB: too large for this page`);
    try {
        return await readMapFile(new Uint8Array(await file.arrayBuffer()), describe);
    } catch (error) {
        const said = error instanceof RangeError ? t('it is too large for this page') : error.message;
        throw new Error(t`${file.name} was not opened: ${said}`);
    }
}

/** Listens for files on the whole page. @param {(file: File) => void} take */
export function acceptDrops(take) {
    const body = document.body, hasFile = (e) => [...(e.dataTransfer?.types ?? [])].includes('Files');
    body.addEventListener('dragover', (event) => {
        if (!hasFile(event)) return;
        event.preventDefault();
        body.classList.add('dropping');
    });
    body.addEventListener('dragleave', (event) => {
        if (!event.relatedTarget) body.classList.remove('dropping');
    });
    body.addEventListener('drop', (event) => {
        body.classList.remove('dropping');
        const [file] = event.dataTransfer?.files ?? [];
        if (!file) return;
        event.preventDefault();
        take(file);
    });
}

/** A camera for a picture of the whole map, 1600 pixels wide at most. */
function pictureCamera(bounds) {
    const w = bounds[2] - bounds[0] || 1, h = bounds[3] - bounds[1] || 1;
    const width = Math.min(1600, Math.max(400, (1200 * w) / h)), height = Math.min(1600, Math.max(300, (width * h) / w));
    const camera = new Camera(Math.round(width), Math.round(height));
    camera.fit(bounds, 30);
    return camera;
}

/** @param {(surface: any, camera: Camera) => void} over marks above the plan */
export function savePng(scene, bounds, tones, over) {
    const camera = pictureCamera(bounds), canvas = document.createElement('canvas');
    canvas.width = camera.width;
    canvas.height = camera.height;
    const surface = canvas.getContext('2d');
    drawPlan(surface, camera, scene, tones);
    over(surface, camera);
    canvas.toBlob((blob) => save(blob, 'plan.png'), 'image/png');
}

export function saveSvg(scene, bounds, tones, over) {
    const camera = pictureCamera(bounds), surface = new SvgSurface(camera.width, camera.height, 'Plan');
    drawPlan(surface, camera, scene, tones);
    over(surface, camera);
    save(new Blob([surface.text()], { type: 'image/svg+xml' }), 'plan.svg');
}
