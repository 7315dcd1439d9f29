import type { JsonObject } from '../../form/json';

/** What the page gives to either of its forms. */
export interface FormProps {
  /** The document to begin with; null: the start that the address names. */
  given: JsonObject | null;
  /** The id under which it was saved. */
  saved: string | null;
  presets: ReadonlySet<string>;
  /** Ids of all scenarios there are. */
  taken: ReadonlySet<string>;
  /** Another document takes the form's place; null: the start that the address names. */
  onopen: (document: JsonObject | null) => void;
  /** The reader changed something. */
  onedit: (document: JsonObject) => void;
  onsaved: (id: string) => void;
  /** The page is about to be left for a run of this document: the way back must find it. */
  onleave: (document: JsonObject) => Promise<void>;
}
