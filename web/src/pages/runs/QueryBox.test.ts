import { cleanup, render, screen } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { ApiProblem } from '../../api/problem';
import QueryBox from './QueryBox.svelte';

afterEach(cleanup);

describe('QueryBox', () => {
  it('asks what was typed, trimmed, on Enter', async () => {
    const onsearch = vi.fn();
    render(QueryBox, { query: '', problem: null, onsearch });
    await userEvent.type(screen.getByRole('searchbox'), '  seed:1..9 OR tags:paper {Enter}');
    expect(onsearch).toHaveBeenCalledWith('seed:1..9 OR tags:paper');
  });

  it('points at the column the server names', () => {
    const problem = new ApiProblem(400, 'Bad Request', 'expected a value', [{ pointer: '', detail: 'column 6: expected a value' }]);
    const { container } = render(QueryBox, { query: 'seed:(', problem, onsearch: () => {} });
    expect(screen.getByRole('alert').textContent).toContain('expected a value');
    expect(container.querySelector('mark')?.textContent).toBe('(');
    expect(screen.getByRole('searchbox').getAttribute('aria-invalid')).toBe('true');
    const input = screen.getByRole<HTMLInputElement>('searchbox');
    expect([input.selectionStart, input.selectionEnd]).toEqual([5, 6]);
  });

  it('shows what the server says as text', () => {
    const problem = new ApiProblem(400, 'Bad Request', '<img src=x onerror=alert(1)>', []);
    const { container } = render(QueryBox, { query: 'x', problem, onsearch: () => {} });
    expect(container.querySelector('img')).toBeNull();
    expect(screen.getByRole('alert').textContent).toContain('<img');
  });
});
