// The frame that is shown, in words.

import { ACTIVITIES, PART_STATES, graspReason, length, reasonsOf } from './frame.js';

function number(value, digits, unit) {
  const text = value.toFixed(digits);
  return `${Number(text) === 0 ? (0).toFixed(digits) : text} ${unit}`; // no -0.00
}

function rowsOfHand(hand, name, info) {
  const holds = info.parts[hand.part] ?? 'nothing';
  const rows = [[name, `holds ${holds}`]];
  if (hand.activity > 0) rows.push(['hand', ACTIVITIES[hand.activity]]);
  if (hand.grasp > 0) rows.push(['grasp', graspReason(hand, info.grasp_words)]);
  if (hand.part < 0 && hand.grasp > 0 && hand.lack > 0) rows.push(['not held', info.grasp_words.lacks[hand.lack]]);
  const hasFingers = hand.links.length > 0;
  if (hasFingers && !info.has_loop) return rows; // no device feels what they do
  rows.push(['force', number(length(hand.force), 2, 'N')], ['torque', number(length(hand.torque), 3, 'Nm')]);
  if (hasFingers) rows.push(['finger torque', number(hand.jointTorque, 3, 'Nm')]);
  const reasons = [...new Set([...reasonsOf(hand.reasons), ...reasonsOf(hand.gloveReasons)])];
  if (hand.unsolved) reasons.push('contacts have no solution');
  if (reasons.length > 0) rows.push(['force is reduced', reasons.join(', ')]);
  return rows;
}

function rowsOfPart(part, name) {
  return [
    [name, PART_STATES[part.state] ?? 'unknown'],
    ['lag', `${number(part.lag, 2, 'mm')}, ${number(part.angle, 1, '°')}`],
    ['contacts', `${part.contacts}`],
  ];
}

export function rowsOf(frame, info, isLive) {
  const patches = frame.patches.length + frame.patchesLeftOut;
  const missed = isLive ? [['frames missed', `${frame.missed}`]] : [];
  return [
    ...frame.hands.map((hand, h) => rowsOfHand(hand, info.hands[h]?.name ?? `hand ${h}`, info)),
    ...frame.parts.map((part, p) => rowsOfPart(part, info.parts[p] ?? `part ${p}`)),
    ...(patches > 0 ? [[['patches', `${patches}${frame.patchesLeftOut > 0 ? `, ${frame.patchesLeftOut} not shown` : ''}`]]] : []),
    ...(info.has_loop ? [[
      ['loop', frame.late ? 'contacts are late' : 'on time'],
      ['age of contacts', number(frame.age, 1, 'ms')],
      ['lateness of ticks', number(frame.lateness, 0, 'µs')],
      ...missed,
    ]] : []),
  ];
}

// The patches of a part, the one with the greatest force first.
function rowsOfPatches(part, frame) {
  return frame.patches.filter((patch) => patch.part === part).map(({ contacts, extent }) => [
    'patch', `${contacts} ${contacts === 1 ? 'contact' : 'contacts'}, ${number(1e3 * extent, 1, 'mm')} from the centre at most`,
  ]);
}

// Fills a definition list; only what has changed is touched, so that screen readers and selections stay calm.
export function showRows(list, groups) {
  const lines = groups.flatMap((rows) => rows.map(([name, value], i) => ({ name, value, isHead: i === 0 })));
  while (list.children.length > 2 * lines.length) list.lastChild.remove();
  lines.forEach(({ name, value, isHead }, i) => {
    const place = 2 * i;
    if (!list.children[place]) list.append(document.createElement('dt'), document.createElement('dd'));
    const [term, detail] = [list.children[place], list.children[place + 1]];
    if (term.textContent !== name) term.textContent = name;
    if (detail.textContent !== value) detail.textContent = value;
    term.className = detail.className = isHead ? 'head' : '';
  });
}

// What is known of an object that was picked.
export function rowsOfObject(node, frame, info) {
  const { name, kind, part, triangles, hand } = node.userData;
  const rows = [[name, kind === 'segment' ? 'segment of a hand' : kind]];
  if (triangles) rows.push(['triangles', triangles.toLocaleString('en')]);
  const place = node.position.toArray().map((x, i) => 1e3 * (x + info.origin_W_m[i]));
  rows.push(['position', `${place.map((x) => x.toFixed(1)).join(', ')} mm`]);
  if (frame && part !== undefined && frame.parts[part]) rows.push(...rowsOfPart(frame.parts[part], 'state'), ...rowsOfPatches(part, frame));
  if (frame && hand !== undefined && frame.hands[hand]) rows.push(...rowsOfHand(frame.hands[hand], 'hand', info));
  return rows;
}
