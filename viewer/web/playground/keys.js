/**
 * The keyboard: a cross on the plan stands for the pointer, and Enter for its button. So every tool
 * works without a mouse.
 */
const toolKeys = { v: 'look', y: 'why', w: 'wall', d: 'door', m: 'move', s: 'start', r: 'mirror', g: 'oneway', c: 'cameras', l: 'line', t: 'path' };
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Keys {
    /** @param {HTMLCanvasElement} canvas @param {any} app */
    constructor(canvas, app) {
        this.app = app;
        /** The cross, null while the keyboard is not in use. @type {[number, number] | null} */
        this.cross = null;
        this.held = false;
        canvas.addEventListener('keydown', (e) => this.onPlan(e));
        canvas.addEventListener('pointerdown', () => this.hide());
        document.addEventListener('keydown', (e) => this.anywhere(e));
    }

    hide() {
        this.cross = null;
        this.held = false;
    }

    anywhere(event) {
        const key = event.key.toLowerCase();
        if (key === '?' && !event.target.matches('select, input:not([type=checkbox], [type=radio])')) return this.app.act('help');
        if (!(event.ctrlKey || event.metaKey) || /^(input|textarea|select)$/i.test(event.target.type ?? '')) return;
        const what = key === 'z' ? (event.shiftKey ? 'redo' : 'undo') : { y: 'redo', s: 'saveMap', o: 'open' }[key];
        if (!what) return;
        event.preventDefault();
        this.app.act(what);
    }

    onPlan(event) {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const key = event.key;
        if (arrows[key]) this.walk(arrows[key], event.shiftKey);
        else if (key === 'Enter' || key === ' ') this.click();
        else if (key === 'Escape') this.escape();
        else if (key === 'Delete' || key === 'Backspace') this.app.act('remove');
        else if (key === '+' || key === '=') this.app.act('zoomIn');
        else if (key === '-') this.app.act('zoomOut');
        else if (key === '0') this.app.act('fit');
        else if (key === 'n' || key === 'p') this.app.selectNext(key === 'n' ? 1 : -1);
        else if (toolKeys[key.toLowerCase()]) this.app.chooseTool(toolKeys[key.toLowerCase()]);
        else return;
        event.preventDefault();
    }

    walk([dx, dy], far) {
        const step = this.app.step() * (far ? 10 : 1);
        this.cross ??= this.app.snap(this.app.middle());
        const tidy = (v) => Math.round(v * 1e9) / 1e9;
        this.cross = [tidy(this.cross[0] + dx * step), tidy(this.cross[1] + dy * step)];
        this.app.showPlace(this.cross);
        this.app.move(this.cross, this.held);
    }

    /** Enter presses and lets go; with the tool that moves things, it takes and puts down. */
    click() {
        this.cross ??= this.app.snap(this.app.middle());
        if (this.app.tool === 'move') {
            if (this.held) this.app.release(this.cross);
            else this.app.press(this.cross);
            this.held = !this.held && Boolean(this.app.tools.move.held);
            return;
        }
        this.app.press(this.cross);
        this.app.release(this.cross);
    }

    escape() {
        this.held = false;
        this.app.cancelTool();
    }
}

/**
 * Acts on what is chosen in a list. By keys only after Enter, or when the list is left: each arrow chooses anew.
 * @param {HTMLSelectElement} list @param {(value: string) => any} act
 */
export function onChosen(list, act) {
    let typed = false, waits = false;
    const go = () => {
        if (waits) act(list.value);
        typed = waits = false;
    };
    list.addEventListener('keydown', (event) => {
        typed = true;
        if (event.key === 'Enter') go();
    });
    list.addEventListener('pointerdown', () => (typed = false));
    list.addEventListener('change', () => {
        waits = true;
        if (!typed) go();
    });
    list.addEventListener('blur', go);
}
