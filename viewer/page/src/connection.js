// The live frames of the server that the page came from. Connects again by itself.

import { decodeFrame } from './frame.js';

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 2000;
const HIDDEN_MS = 500;
const NORMAL_END = 1000; // code of a WebSocket that the server has closed on purpose

export class Connection {
  // Before it connects, `prepare()` loads what the frames need. Then `onFrame(frame)` and `onState(state)`, which is
  // 'connected', 'ended' by the server, or 'lost'. Each frame is acknowledged once the page has shown it, so that a slow
  // page gets fewer of them instead of late ones.
  constructor(prepare, onFrame, onState) {
    this.prepare = prepare;
    this.onFrame = onFrame;
    this.onState = onState;
    this.wait = FIRST_WAIT_MS;
    this.hasEnded = false;
    this.connect();
  }

  connectLater() {
    this.onState(this.hasEnded ? 'ended' : 'lost');
    setTimeout(() => this.connect(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
  }

  async connect() {
    try {
      await this.prepare();
    } catch {
      this.connectLater();
      return;
    }
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = FIRST_WAIT_MS;
      this.hasEnded = false;
      this.onState('connected');
    };
    socket.onmessage = (event) => {
      this.onFrame(decodeFrame(event.data));
      let isShown = false;
      const acknowledge = () => {
        if (!isShown && socket.readyState === WebSocket.OPEN) socket.send('shown');
        isShown = true;
      };
      requestAnimationFrame(acknowledge);
      setTimeout(acknowledge, HIDDEN_MS); // a hidden page draws nothing, but goes on listening
    };
    socket.onclose = (event) => {
      this.hasEnded = this.hasEnded || event.code === NORMAL_END;
      this.connectLater();
    };
  }
}
