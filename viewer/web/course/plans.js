/** Which slides each plan of a lecture has, and when each of them ends. */

/** The lectures of each plan: the minutes that each chapter takes. */
export const plans = {
    45: [{ here: 8, rooms: 8, lines: 14, hidden: 6, cost: 9 }],
    90: [{ here: 10, rooms: 15, lines: 20, search: 15, hidden: 15, cost: 15 }],
    '4x90': [{ here: 25, rooms: 30, lines: 35 }, { program: 30, search: 30, rounding: 30 }, { hidden: 25, sweep: 25, view: 20, regions: 20 },
        { frames: 15, effects: 15, cost: 20, gallery: 20, ways: 20 }],
};

/** Shares of a chapter's minutes. */
const shares = { title: 1, puzzle: 4, 'key-statement': 3, formula: 4, figure: 6, prediction: 5, summary: 2 };

/** The shortest plan leaves formulas out. */
const has = (plan, kind) => plan !== '45' || kind !== 'formula';

/**
 * The slides of a plan in order, each with its lecture, and with the minutes of this lecture at which it begins and ends.
 * @param {string} plan @param {{chapter: string, kind: string}[]} slides all that there are
 */
export const slidesOf = (plan, slides) => plans[plan].flatMap((chapters, i) => {
    let end = 0;
    return Object.entries(chapters).flatMap(([chapter, minutes]) => {
        const own = slides.filter((slide) => slide.chapter === chapter && has(plan, slide.kind)), sum = own.reduce((all, { kind }) => all + shares[kind], 0);
        return own.map((slide) => ({ ...slide, lecture: i + 1, begin: end, end: (end += (minutes * shares[slide.kind]) / sum) }));
    });
});
