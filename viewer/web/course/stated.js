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
