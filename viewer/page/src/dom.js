// What all of the page needs of the document.

export const byId = (id) => document.getElementById(id);

export function append(parent, tag, text = '', className = '') {
  const element = Object.assign(document.createElement(tag), { textContent: text, className });
  parent.append(element);
  return element;
}
