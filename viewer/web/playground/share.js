/** A map in the fragment of an address, and in the browser's store. Nothing goes to a server. */
import { t } from '../language/language.js';

/** Browsers and chat programs take addresses up to about this. */
export const LONG_ADDRESS = 30000;

const toBase64 = (bytes) => {
    let text = '';
    for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
    return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
};

const fromBase64 = (text) =>
    Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));

const through = async (bytes, stream) =>
    new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/** @param {string} text @returns {Promise<string>} the fragment, without # */
export async function packMap(text) {
    const bytes = new TextEncoder().encode(text);
    if (typeof CompressionStream !== 'function') return `t=${toBase64(bytes)}`;
    return `m=${toBase64(await through(bytes, new CompressionStream('deflate-raw')))}`;
}

/** What a shared map may be at most once it is unpacked: a small fragment can hold a huge map. */
const MOST_BYTES = 64 << 20;

async function inflate(bytes) {
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
    const parts = [];
    let size = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        size += value.length;
        if (size > MOST_BYTES) throw new Error('too large');
        parts.push(value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** @param {string} fragment with or without # @returns {Promise<string | null>} null where it holds no map */
export async function unpackMap(fragment) {
    const found = /^#?([mt])=(.*)$/s.exec(fragment);
    if (!found) return null;
    try {
        if (!/^[\w-]+$/.test(found[2])) throw new Error('no base64url');
        const bytes = fromBase64(found[2]);
        return new TextDecoder('utf-8', { fatal: true }).decode(found[1] === 'm' ? await inflate(bytes) : bytes);
    } catch {
        throw new Error(t('The address holds a map that cannot be read. Perhaps its end was cut off.'));
    }
}

/** What the browser keeps: the last map, and the one before a shared map was opened. */
const KEYS = { last: 'sightline-playground-map', own: 'sightline-playground-own' };

/** @param {'last' | 'own'} which @returns {string | null} */
export function loadWork(which = 'last') {
    try {
        return localStorage.getItem(KEYS[which]);
    } catch {
        return null;
    }
}

/** @param {'last' | 'own'} which @returns {boolean} whether the browser kept it */
export function keepWork(text, which = 'last') {
    try {
        localStorage.setItem(KEYS[which], text);
        return true;
    } catch {
        return false;
    }
}
