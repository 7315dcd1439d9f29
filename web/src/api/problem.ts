/// An error the server explained (RFC 9457), or a connection that failed.
export interface ProblemField {
  pointer: string;
  detail: string;
  allowed?: unknown;
}

export class ApiProblem extends Error {
  constructor(
    /** HTTP status; 0: no answer came. */
    readonly status: number,
    readonly title: string,
    readonly detail: string,
    readonly errors: ProblemField[] = [],
    readonly requestId: string | null = null,
    /** s after which the server asks to be tried again; null: it does not say. */
    readonly retryAfter: number | null = null,
  ) {
    super(detail || title);
    this.name = 'ApiProblem';
  }

  static async from(response: Response): Promise<ApiProblem> {
    const id = response.headers.get('X-Request-Id');
    const wait = response.headers.get('Retry-After');
    const retryAfter = wait !== null && /^\d+$/.test(wait) ? Number(wait) : null;
    try {
      const body = (await response.json()) as Partial<{ title: string; detail: string; errors: ProblemField[]; request_id: string }>;
      return new ApiProblem(response.status, body.title ?? response.statusText, body.detail ?? '', body.errors ?? [], body.request_id ?? id, retryAfter);
    } catch {
      return new ApiProblem(response.status, response.statusText || String(response.status), '', [], id, retryAfter);
    }
  }
}

/** One sentence for a person: what the server said, with the field it names. */
export function sentence(error: unknown): string {
  if (error instanceof ApiProblem) {
    const field = error.errors[0];
    if (field) return field.pointer ? `${field.pointer}: ${field.detail}` : field.detail;
    return error.detail || error.title;
  }
  return error instanceof Error ? error.message : String(error);
}
