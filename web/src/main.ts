import { mount } from 'svelte';
import App from './App.svelte';
import './theme/tokens.css';
import './theme/base.css';
import './theme/theme.svelte';

const target = document.getElementById('app');
if (target) mount(App, { target });
