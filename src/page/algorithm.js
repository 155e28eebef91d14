// The sections of docs/algorithm.md, which the page carries: its markdown, as far as that page uses it, as elements.
'use strict';

const algorithmText = new TextDecoder().decode(
    Uint8Array.from(atob($('algorithm-text').textContent.trim()), c => c.charCodeAt(0)),
);
const algorithmSections = new Map(
    algorithmText
        .split(/^## /m)
        .map(part => [Number.parseInt(part, 10), part])
        .filter(([number]) => number > 0),
);

const sectionTitle = number => (algorithmSections.get(number) || `${number}.`).split('\n')[0];

// `code`, **bold**, *italic*, and links as their words.
function spans(text) {
    const out = document.createDocumentFragment();
    for (const piece of text
        .replace(/!?\[([^\]]*)\]\([^)]*\)/g, '$1')
        .split(/(`[^`]+`|\*\*[^*]+\*\*|\*[^*\s][^*]*\*)/)) {
        const name = piece.startsWith('`')
            ? 'code'
            : piece.startsWith('**')
              ? 'strong'
              : /^\*[^*]+\*$/.test(piece)
                ? 'em'
                : '';
        out.append(name ? element(name, {}, piece.replace(/^(`|\*+)|(`|\*+)$/g, '')) : piece);
    }
    return out;
}

function drawingOf(name, words) {
    const data = document.querySelector(`script[data-image="${name}"]`);
    return data && element('img', {src: 'data:image/svg+xml;base64,' + data.textContent.trim(), alt: words});
}

function block(text) {
    if (/^```/.test(text)) return element('pre', {}, text.replace(/^```.*\n|\n?```$/g, ''));
    if (/^#+ /.test(text)) return element('h3', {}, spans(text.replace(/^#+ /, '')));
    if (/^ {4}/.test(text)) return element('pre', {}, text.replace(/^ {4}/gm, ''));
    const drawing = /^!\[(.*)\]\(images\/(.*)\)$/.exec(text.replace(/\n/g, ' '));
    if (drawing) return drawingOf(drawing[2], drawing[1]);
    if (/^<[^>]*>$/.test(text)) return null; // the ends of a fold
    if (/^\|/.test(text))
        return element(
            'table',
            {},
            ...text
                .split('\n')
                .filter(line => !/^\|[-| :]+\|$/.test(line))
                .map(line =>
                    element(
                        'tr',
                        {},
                        ...line
                            .split('|')
                            .slice(1, -1)
                            .map(cell => element('td', {}, spans(cell.trim()))),
                    ),
                ),
        );
    if (/^(-|\d+\.) /.test(text))
        return element(
            'ul',
            {},
            ...text
                .split(/\n(?=- |\d+\. )/)
                .map(item => element('li', {}, spans(item.replace(/^(-|\d+\.) /, '')))),
        );
    return element('p', {}, spans(text));
}

function showSection(number) {
    const [title, ...rest] = (algorithmSections.get(number) || '').split('\n');
    const blocks = rest.join('\n').match(/```[\s\S]*?```|(?:(?!```)[^\n]+\n?)+/g) || [];
    $('section-title').textContent = title;
    $('section-text').replaceChildren(...blocks.map(text => block(text.trimEnd())).filter(Boolean));
    $('section').showModal();
}
