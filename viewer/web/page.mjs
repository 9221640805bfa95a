/** The frame of a page that the build writes: its head with the policy, and links to all parts of the site. */

/**
 * What pages may load: files of the site, and what they made themselves: pictures, and addresses that a worker asks for.
 * Nothing comes from elsewhere, no code or style stands in a page, and no form is sent.
 */
export const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; " +
    "connect-src 'self' blob:; worker-src 'self'; base-uri 'none'; form-action 'none'";

/**
 * @param {string} title in HTML, as is `body`
 * @param {Object} options `about` is for those who link to the page; without it that is the first paragraph. `chapter` is the name of a module of the course, `root` leads to the top of the site,
 *   `isSecret` is for pages that search engines leave out
 */
export const page = (title, body, { about = '', chapter = '', isCourse = Boolean(chapter), isSecret = false, root = '../' } = {}) => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">${isSecret ? '\n<meta name="robots" content="noindex">' : ''}
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>${title} - Sightline</title>${about ? `\n<meta name="description" content="${about}">` : ''}
<link rel="icon" href="${root}icon.svg">
<link rel="stylesheet" href="${root}style.css">${isCourse ? `\n<link rel="stylesheet" href="${root}course/course.css">` : ''}${chapter ? `\n<script type="module" src="${root}course/course.js"></script>` : ''}
</head>
<body${chapter ? ` data-chapter="${chapter}"` : ''}>
<header><nav aria-label="Pages">
<a href="${root}index.html">Playground</a>
<a href="${root}course/index.html">Course</a>
<a href="${root}pages/floor-plans.html">Floor plans</a>
<a href="${root}pages/game-maps.html">Game maps</a>
<a href="${root}pages/teaching.html">Teaching</a>
<a href="${root}pages/embedding.html">Embedding</a>
</nav></header>
<main class="page">
${body}
</main>
</body>
</html>
`;
