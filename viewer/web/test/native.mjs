/** Help for tests: what the native program makes of a map. SIGHTLINE names the program. */
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const native = process.env.SIGHTLINE;
export const needsNative = { skip: native ? false : 'SIGHTLINE does not name the program' };

/** What the program makes of a map in a folder of its own. @param {[string, string, ...string[]][]} files */
export function bakeNative(files) {
    const folder = mkdtempSync(join(tmpdir(), 'sightline-web-'));
    try {
        return files.map(([name, content, ...options]) => {
            writeFileSync(join(folder, name), content);
            const out = join(folder, 'x.json'), slv = join(folder, 'x.slv');
            execFileSync(native, ['bake', join(folder, name), '-o', slv, '--quiet', ...options], { stdio: 'pipe' });
            execFileSync(native, ['export', slv, '--format', 'json', '-o', out], { stdio: 'pipe' });
            return JSON.parse(readFileSync(out, 'utf8'));
        });
    } finally {
        rmSync(folder, { recursive: true });
    }
}

/** Cells as sets of corners, so that their order does not matter. */
export const shapes = (plan) => plan.cells.filter((c) => c.inside).map((c) => c.polygon.map(String).sort().join(' ')).sort();
