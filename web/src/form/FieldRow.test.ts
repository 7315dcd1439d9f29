import { cleanup, render, screen } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Field } from './fields';
import FieldRow from './FieldRow.svelte';

afterEach(cleanup);

function field(more: Partial<Field>): Field {
  return {
    path: ['lanes', 'a', 'params', 'tau'], pointer: '/lanes/a/params/tau', kind: 'number', name: 'tau', meaning: { en: 'Margin', zh: '裕度' },
    unit: 's', symbol: 'τ', source: '', live: true, nullable: false, required: false, choices: [], labels: {}, minimum: 0, maximum: undefined,
    exclusiveMinimum: undefined, exclusiveMaximum: undefined, minItems: undefined, maxItems: undefined, columns: undefined, pattern: undefined,
    default: 0.01, value: 0.01, ...more,
  };
}

function show(more: Partial<Field>, props: { changed?: boolean; faults?: string[] } = {}) {
  const onchange = vi.fn();
  const onreset = vi.fn();
  render(FieldRow, { field: field(more), changed: props.changed ?? false, faults: props.faults ?? [], onchange, onreset });
  return { onchange, onreset };
}

describe('FieldRow', () => {
  it('is labelled by name, symbol and unit, and says limits and default', () => {
    show({});
    const input = screen.getByRole('textbox', { name: /tau.*τ.*s/ });
    expect((input as HTMLInputElement).value).toBe('0.01');
    expect(screen.getByText('≥ 0')).toBeTruthy();
    expect(screen.getByText('default 0.01')).toBeTruthy();
    expect(screen.getByText('Margin')).toBeTruthy();
  });

  it('gives numbers as numbers and keeps what is none as it was typed', async () => {
    const { onchange } = show({});
    const input = screen.getByRole('textbox');
    await userEvent.clear(input);
    expect(onchange).toHaveBeenLastCalledWith(['lanes', 'a', 'params', 'tau'], undefined);
    await userEvent.type(input, '2e-3');
    expect(onchange).toHaveBeenLastCalledWith(['lanes', 'a', 'params', 'tau'], 0.002);
    await userEvent.type(input, 'x');
    expect(onchange).toHaveBeenLastCalledWith(['lanes', 'a', 'params', 'tau'], '2e-3x');
  });

  it('switches a nullable field to automatic and back', async () => {
    const { onchange } = show({ nullable: true, minimum: 0.5 });
    await userEvent.click(screen.getByRole('checkbox', { name: 'tau: auto' }));
    expect(onchange).toHaveBeenLastCalledWith(expect.anything(), null);
    cleanup();
    const again = show({ nullable: true, value: null, minimum: 0.5 });
    await userEvent.click(screen.getByRole('checkbox', { name: 'tau: auto' }));
    expect(again.onchange).toHaveBeenLastCalledWith(expect.anything(), 0.5);
  });

  it('pastes a row of cells into a vector', async () => {
    const { onchange } = show({ kind: 'vector', value: [1, 1, 1], minItems: 3, maxItems: 3 });
    const first = screen.getByRole('textbox', { name: 'tau, entry 1' });
    await userEvent.click(first);
    await userEvent.paste('4\t5\t6');
    expect(onchange).toHaveBeenLastCalledWith(expect.anything(), [4, 5, 6]);
    await userEvent.paste('4\tfive');
    expect(screen.getByRole('alert').textContent).toContain('“five”');
  });

  it('shows faults beside the field and offers the way back', async () => {
    const { onreset } = show({}, { changed: true, faults: ['Too small.'] });
    expect(screen.getByRole('textbox').getAttribute('aria-invalid')).toBe('true');
    const note = document.getElementById(screen.getByRole('textbox').getAttribute('aria-describedby')!);
    expect(note?.textContent).toContain('Too small.');
    await userEvent.click(screen.getByRole('button'));
    expect(onreset).toHaveBeenCalledWith(['lanes', 'a', 'params', 'tau']);
  });
});
