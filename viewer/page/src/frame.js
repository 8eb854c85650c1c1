// A frame as viewer/view_frame.h describes it.

export const PART_STATES = ['unknown', 'released', 'free', 'sliding', 'resting', 'catching up'];
export const ACTIVITIES = ['none', 'lost', 'waiting until it is free', 'free', 'holding'];
// By bit; the first seven let the force fade to zero.
export const REASONS = [
  'emergency stop', 'enable switch is open', 'glove obeys another server', 'number is not finite', 'pose is implausible',
  'glove state is old', 'command is old', 'force returns softly', 'force limit', 'torque limit', 'joint limit',
  'rate limit', 'power limit', 'mean force limit', 'energy limit',
];

// Why a grasp is one, in the words of the server.
export function graspReason(hand, words) {
  const kind = words.kinds[hand.grasp] ?? words.kinds[0];
  const form = words.forms[hand.form] ?? '';
  const segments = words.segments.filter((_, bit) => (hand.touching >> bit) & 1);
  const list = segments.length < 2 ? segments.join('') : `${segments.slice(0, -1).join(', ')} and ${segments.at(-1)}`;
  const name = form === '' ? kind : `${kind}, ${form}`;
  return list === '' ? name : `${name}: ${list} ${segments.length === 1 ? 'touches' : 'touch'}`;
}

export function reasonsOf(bits) {
  return REASONS.filter((_, bit) => (bits >> bit) & 1);
}

class Reader {
  constructor(buffer) {
    this.view = new DataView(buffer);
    this.offset = 0;
  }

  double() {
    this.offset += 8;
    return this.view.getFloat64(this.offset - 8, true);
  }

  number() {
    this.offset += 4;
    return this.view.getFloat32(this.offset - 4, true);
  }

  numbers(count) {
    return Array.from({ length: count }, () => this.number());
  }

  list(count, read) {
    return Array.from({ length: count }, read);
  }

  // Position in metres; quaternion as x, y, z, w, which is three.js' order.
  pose() {
    const [x, y, z, qw, qx, qy, qz] = this.numbers(7);
    return { p: [x, y, z], q: [qx, qy, qz, qw] };
  }
}

function part(reader) {
  return {
    ghost: reader.pose(),
    visible: reader.pose(),
    lag: 1e3 * reader.number(), // mm, of the reference point
    angle: reader.number() * 180 / Math.PI,
    state: reader.number(),
    contacts: reader.number(),
  };
}

function hand(reader) {
  return {
    part: reader.number(),
    force: reader.numbers(3),
    torque: reader.numbers(3),
    peak: reader.number(),
    share: reader.number(),
    unsolved: reader.number() !== 0,
    reasons: reader.number(),
    gloveReasons: reader.number(),
    energy: reader.number(),
    activity: reader.number(),
    grasp: reader.number(),
    form: reader.number(),
    touching: reader.number(),
    lack: reader.number(),
    jointTorque: reader.number(),
    links: reader.list(reader.number(), () => reader.pose()),
  };
}

function contact(reader) {
  return { part: reader.number(), p: reader.numbers(3), n: reader.numbers(3) };
}

function patch(reader) {
  const part = reader.number();
  const contacts = reader.number();
  return { part, contacts, p: reader.numbers(3), n: reader.numbers(3), extent: reader.number() };
}

export function decodeFrame(buffer) {
  const reader = new Reader(buffer);
  const frame = { time: reader.double(), sequence: reader.double(), late: reader.number() !== 0 };
  [frame.age, frame.lateness, frame.duration, frame.missed] = reader.numbers(4);
  const [parts, hands, contacts, patches] = reader.numbers(4);
  frame.patchesLeftOut = reader.number();
  frame.parts = reader.list(parts, () => part(reader));
  frame.hands = reader.list(hands, () => hand(reader));
  frame.contacts = reader.list(contacts, () => contact(reader));
  frame.patches = reader.list(patches, () => patch(reader));
  return frame;
}

// Frames one after another, each after its length in bytes.
export function decodeFrames(buffer) {
  const view = new DataView(buffer);
  const frames = [];
  for (let offset = 0; offset < buffer.byteLength;) {
    const length = view.getUint32(offset, true);
    frames.push(decodeFrame(buffer.slice(offset + 4, offset + 4 + length)));
    offset += 4 + length;
  }
  return frames;
}

// Equal texts for frames that look the same in the three-dimensional picture.
export function pictureOf(frame) {
  return JSON.stringify([
    frame.parts.map((part) => [part.ghost, part.visible]),
    frame.hands.map((hand) => [hand.part, hand.force, hand.torque, hand.links]),
    frame.contacts,
    frame.patches,
  ]);
}

export function length(v) {
  return Math.hypot(...v);
}
