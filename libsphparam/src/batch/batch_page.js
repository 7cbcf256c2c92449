// The shapes of a batch: `rows` (see row_json) and `folder`, where their results lie. Only one leaf
// of them is in the document at a time, so that ten thousand open as fast as ten.
(() => {
  const [ID, OUTCOME, VERTICES, AREA, ANGLE, WITHIN, SECONDS, OUT, PICTURE, PAGE, CODE, REASON,
    ATTEMPT, REPAIRS, WARNINGS] = [...Array(15).keys()];
  const leafSize = 60, farOut = 1.5;
  const state = {words: '', which: 'all', order: 'outliers', leaf: 0, chosen: ''};

  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };
  const number = value => value === null ? '–' : value.toLocaleString('en');
  const down = column => (a, b) => (b[column] ?? -Infinity) - (a[column] ?? -Infinity);

  const wrapped = row => row[REPAIRS].includes('wrapped');
  const trouble = row => row[OUTCOME] === 'failed' ? 1 : 0;
  const orders = {
    outliers: ['outliers first', (a, b) => down(OUT)(a, b)],
    failed: ['failures first', (a, b) => trouble(b) - trouble(a) || down(OUT)(a, b)],
    plan: ['as planned', () => 0],
    name: ['by name', (a, b) => a[ID].localeCompare(b[ID], 'en', {numeric: true})],
    area: ['most area distortion', down(AREA)],
    angle: ['most angle distortion', down(ANGLE)],
    vertices: ['most vertices', down(VERTICES)],
    seconds: ['longest', down(SECONDS)],
  };
  const kinds = {
    all: ['all', () => true],
    outliers: ['outliers', row => row[OUT] > farOut],
    certified: ['certified', row => row[OUTCOME] === 'certified'],
    done: ['done, without a map', row => row[OUTCOME] === 'done'],
    repaired: ['repaired', row => row[REPAIRS] !== '' && row[REPAIRS] !== 'wrapped 1'],
    wrapped: ['wrapped', row => wrapped(row)],
    warned: ['with warnings', row => row[WARNINGS].length > 0],
    failed: ['failed', row => row[OUTCOME] === 'failed'],
    open: ['not run', row => row[OUTCOME] === 'open'],
  };

  const choice = (options, key) => {
    const select = element('select', {'data-key': key});
    for (const [value, [label, holds]] of Object.entries(options)) {
      const count = key === 'which' ? ` (${number(rows.filter(holds).length)})` : '';
      select.append(element('option', {value}, label + count));
    }
    select.addEventListener('change', () => show({[key]: select.value, leaf: 0, chosen: ''}));
    return select;
  };
  const words = element('input', {type: 'search', placeholder: 'name, reason, warning'});
  words.addEventListener('input', () => show({words: words.value, leaf: 0, chosen: ''}));
  const which = choice(kinds, 'which'), order = choice(orders, 'order');
  const before = element('button', {type: 'button'}, '‹ back');
  const after = element('button', {type: 'button'}, 'on ›');
  before.addEventListener('click', () => show({leaf: state.leaf - 1, chosen: ''}));
  after.addEventListener('click', () => show({leaf: state.leaf + 1, chosen: ''}));
  const place = element('output', {'aria-live': 'polite'});
  const cards = element('div', {class: 'cards'});
  document.getElementById('shapes').append(
      element('div', {class: 'controls'}, element('label', {}, 'search', words),
          element('label', {}, 'show', which), element('label', {}, 'order', order), before, after,
          place),
      cards);

  const picture = row => {
    if (!row[PICTURE]) {
      const why = row[OUTCOME] === 'failed' ? 'no map' : row[OUTCOME] === 'open' ? 'not run' :
        'no picture';
      return element('div', {class: 'none'}, why);
    }
    return element('img', {src: folder + row[PICTURE], loading: 'lazy', decoding: 'async',
      width: 256, height: 128, alt: row[ID] + ' and its sphere, coloured by area distortion'});
  };
  const facts = row => {
    const list = element('dl');
    for (const [name, value] of [['vertices', row[VERTICES]], ['area', row[AREA]],
      ['angle', row[ANGLE]], ['area within × 2', row[WITHIN]], ['CPU s', row[SECONDS]]]) {
      if (value !== null) list.append(element('dt', {}, name), element('dd', {}, number(value)));
    }
    return list;
  };
  const links = (row, results) => {
    const line = element('p');
    const link = (path, text) =>
      line.append(element('a', {href: path}, text), ' ');
    const made = row[OUTCOME] === 'certified' || row[OUTCOME] === 'done';
    if (row[PAGE]) link(results + row[PAGE].split('/').map(encodeURIComponent).join('/'), 'page');
    if (made) link(results, 'files');
    if (made) link(results + 'record.json', 'record');
    if (row[OUTCOME] === 'failed') link(folder + 'failed/' + row[ID] + '.json', 'record and log');
    return line;
  };
  const card = row => {
    const results = folder + 'results/' + row[ID] + '/';
    const made = element('article', {class: 'card', id: 'shape-' + row[ID]},
        picture(row), element('h3', {}, row[ID]),
        element('span', {class: 'badge ' + row[OUTCOME]}, row[OUTCOME]));
    if (row[OUT] > farOut) made.append(' ', element('span', {class: 'badge out'}, 'outlier'));
    if (row[REPAIRS]) made.append(' ', element('span', {class: 'badge repaired'},
        wrapped(row) ? 'wrapped' : 'repaired'));
    made.append(facts(row));
    if (row[REPAIRS]) made.append(element('p', {}, row[REPAIRS]));
    for (const warning of row[WARNINGS]) made.append(element('p', {}, `warning: ${warning}`));
    if (row[REASON]) made.append(element('p', {}, `code ${row[CODE]}: ${row[REASON]}`));
    if (row[ATTEMPT] > 1) made.append(element('p', {}, `attempt ${row[ATTEMPT]}`));
    made.append(links(row, results));
    if (row[ID] === state.chosen) made.classList.add('chosen');
    return made;
  };

  const selected = () => {
    const text = state.words.toLowerCase();
    const found = rows.filter(row => kinds[state.which][1](row) &&
      (!text || [row[ID], row[REASON], ...row[WARNINGS]].join(' ').toLowerCase().includes(text)));
    return found.sort(orders[state.order][1]);
  };
  const show = change => {
    Object.assign(state, change);
    const found = selected();
    const leaves = Math.max(1, Math.ceil(found.length / leafSize));
    if (state.chosen) {
      const at = found.findIndex(row => row[ID] === state.chosen);
      if (at >= 0) state.leaf = Math.floor(at / leafSize);
    }
    state.leaf = Math.min(Math.max(state.leaf, 0), leaves - 1);
    const first = state.leaf * leafSize, leaf = found.slice(first, first + leafSize);
    cards.replaceChildren(...leaf.map(card));
    place.textContent = found.length === 0 ? 'none' :
      `${number(first + 1)}–${number(first + leaf.length)} of ${number(found.length)}`;
    before.disabled = state.leaf === 0;
    after.disabled = state.leaf === leaves - 1;
  };
  // "#ID" shows a shape, whatever is filtered.
  const follow = () => {
    const id = decodeURIComponent(location.hash.slice(1));
    if (!rows.some(row => row[ID] === id)) return;
    words.value = '';
    which.value = 'all';
    show({words: '', which: 'all', chosen: id});
    document.getElementById('shape-' + id).scrollIntoView({block: 'center'});
  };
  addEventListener('hashchange', follow);
  show({});
  follow();
})();
