/** Code that passes the labs, by the names of their exercises, and why it does. */
export const solutions = {
    region: {
        why: 'The ray meets the line of the wall at eye + t d = a + s (b - a). Cramer\'s rule gives t and s. The wall is met if s is between 0 and 1 and t is above 0. ' +
            'The small number 1e-9 fails for walls that are far away and close together; the angular sweep needs no such number.',
        code: `function region(eye, walls) {
    const angles = [];
    for (const [ax, ay, bx, by] of walls)
        for (const [x, y] of [[ax, ay], [bx, by]]) {
            const angle = Math.atan2(y - eye[1], x - eye[0]);
            angles.push(angle - 1e-9, angle + 1e-9);
        }
    angles.sort((a, b) => a - b);

    const corners = [];
    for (const angle of angles) {
        const direction = [Math.cos(angle), Math.sin(angle)];
        const distance = nearest(eye, direction, walls);
        corners.push([eye[0] + distance * direction[0], eye[1] + distance * direction[1]]);
    }
    return corners;
}

function nearest(eye, [dx, dy], walls) {
    let best = Infinity;
    for (const [ax, ay, bx, by] of walls) {
        const wx = bx - ax, wy = by - ay, area = dx * wy - dy * wx;
        if (area === 0) continue; // the wall lies along the ray
        const t = ((ax - eye[0]) * wy - (ay - eye[1]) * wx) / area;
        const s = ((ax - eye[0]) * dy - (ay - eye[1]) * dx) / area;
        if (t > 0 && s >= 0 && s <= 1) best = Math.min(best, t);
    }
    return best;
}`,
    },
};
