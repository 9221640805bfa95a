/** Figures in a state that is set from outside: by a slide, or by another window. */

/** A figure that begins in a state. @param {import('./figure.js').Spec} spec @param {Record<string, any>} state by names of handles and controls */
export const statedAt = (spec, state) => ({
    ...spec,
    handles: spec.handles.map((handle) => ({ ...handle, at: state[handle.name] ?? handle.at })),
    controls: spec.controls?.map((control) => ({ ...control, value: state[control.name] ?? control.value })),
});

/** The values of handles and controls. @param {import('./figure.js').Figure} figure */
export const stateOf = ({ spec, state }) =>
    structuredClone(Object.fromEntries([...spec.handles, ...(spec.controls ?? [])].map(({ name }) => [name, state[name]])));

/** Gives handles and controls other values, and shows them. @param {import('./figure.js').Figure} figure */
export function setState(figure, values) {
    Object.assign(figure.state, structuredClone(values));
    for (const field of figure.controls.querySelectorAll('input, select')) {
        const value = values[field.id.replace(/^figure-\d+-/, '')];
        if (typeof value === 'boolean') field.checked = value;
        else if (value !== undefined) field.value = value;
    }
    figure.change();
}
