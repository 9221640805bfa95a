/** What the labs begin with. `your` marks the lines that a student puts in. */

export const regionCode = {
    your: `        // Your lines: where does the ray meet the wall from a to b?
        // Is that before the eye, beside the wall, or on it? Keep the least distance in best.
`,
    get text() {
        return `// eye: [x, y]; walls: [[ax, ay, bx, by], ...], which may touch, but do not cross.
function region(eye, walls) {
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

// How far the ray from the eye goes until it meets a wall.
function nearest(eye, [dx, dy], walls) {
    let best = Infinity;
    for (const [ax, ay, bx, by] of walls) {
${this.your}    }
    return best;
}`;
    },
};

export const searchCode = {
    your: `            // Your lines: does a line pass the sequence and this portal?
            // If so, the search goes on in the cell behind it.
`,
    get text() {
        return `// cells: for each cell its portals, { to, left: [x, y], right: [x, y] } as one leaves the cell.
// Gives the numbers of all cells that the cell \`start\` sees. Lines may touch ends of portals.
function visible(cells, start) {
    const seen = new Set();
    search(start, []);
    return [...seen];

    function search(cell, sequence) {
        seen.add(cell);
        for (const portal of cells[cell]) {
${this.your}        }
    }
}

// Whether a line passes all portals. If one does, then one that goes through two of the ends does.
function stabs(portals) {
    const ends = portals.flatMap(({ left, right }) => [left, right]);
    return goesForward(portals) && ends.some((a) => ends.some((b) => (a[0] !== b[0] || a[1] !== b[1]) &&
        portals.every(({ left, right }) => side(a, b, left) >= 0 && side(a, b, right) <= 0)));
}

// Whether some one direction crosses all portals forwards: it does not, if the search turns back.
function goesForward(portals) {
    const ways = portals.map(({ left, right }) => [left[0] - right[0], left[1] - right[1]]);
    const isFrom = ([ax, ay], [bx, by]) => ax * by - ay * bx > 0 || (ax * by === ay * bx && ax * bx + ay * by > 0);
    return ways.some((a) => ways.every((b) => isFrom(a, b)));
}

// Positive where p lies to the left of the line from a to b.
function side(a, b, p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}`;
    },
};

export const funnelCode = {
    your: `    // Your lines: corner i, and the next one. Keep those that have the end on the right side, or on the line.
    // Where one is kept and the next is not, or the other way round, the line from \`about\` to \`end\` is a new corner.
`,
    get text() {
        return `// portals: [{ left: [x, y], right: [x, y] }, ...], as a line meets them. Lines may touch ends.
// Gives how many of them, from the first one on, one line passes.
function funnel(portals) {
    // All lines through a portal turn about its left end, and then back about its right end.
    const [{ left, right }] = portals;
    let corners = [{ from: right, to: left, about: left }, { from: left, to: right, about: right }];
    for (let i = 1; i < portals.length; i++) {
        corners = cut(corners, portals[i].left, 1);
        corners = cut(corners, portals[i].right, -1);
        if (!corners.length) return i;
    }
    return portals.length;
}

// The lines that have an end to their left (sign 1) or to their right (sign -1).
// A corner is the line from \`from\` to \`to\`. It turns about \`about\` until it is the next corner.
function cut(corners, end, sign) {
    const kept = [];
${this.your}    return kept;
}

// Positive where p lies to the left of the line from a to b.
function side(a, b, p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}`;
    },
};

export const pullCode = {
    your: `    // Your lines: take corners off \`own\` at which the string would not turn left (turn 1) or right (turn -1).
    // If \`own\` has the apex only: while the end lies across the first piece of \`other\`, move the apex along \`other\`.
`,
    get text() {
        return `// portals: [{ left: [x, y], right: [x, y] }, ...], as one walks through them.
// Gives the shortest way: [from, its corners ..., to].
function shortest(from, to, portals) {
    const way = [], left = [from], right = [from]; // two strings; each begins at the apex
    for (const portal of [...portals, { left: to, right: to }]) {
        join(left, right, portal.left, 1, way);
        join(right, left, portal.right, -1, way);
    }
    return [...way, ...left];
}

// Puts an end to its own string. Corners that the apex leaves behind go to \`way\`.
function join(own, other, end, turn, way) {
${this.your}    own.push(end);
}

// Positive where p lies to the left of the line from a to b.
function side(a, b, p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}`;
    },
};
